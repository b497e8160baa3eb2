#include "problems/loader/srdf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include "problems/loader/urdf_structure.h"
#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

std::string text_of(const UrdfElement& element, const char* name) {
  const std::optional<std::string> text = element.attribute(name);
  if (text) return *text;
  element.throw_bad_input(name, "nothing", "a name");
}

std::vector<std::string> names_in(const UrdfElement& element, const char* tag) {
  std::vector<std::string> names;
  for (const UrdfElement& each : element.children(tag)) names.push_back(text_of(each, "name"));
  return names;
}

SrdfGroup read_group(const UrdfElement& element) {
  SrdfGroup group;
  for (const UrdfElement& chain : element.children("chain")) {
    group.chains.emplace_back(text_of(chain, "base_link"), text_of(chain, "tip_link"));
  }
  group.joints = names_in(element, "joint");
  group.links = names_in(element, "link");
  group.groups = names_in(element, "group");
  return group;
}

template <class Value>
const Value& find_named(const std::map<std::string, Value>& values, std::string_view key,
                        const std::string& name, std::string_view noun) {
  const auto found = values.find(name);
  if (found != values.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : values) names.push_back(entry.first);
  throw BadValue(key, shown(name),
                 names.empty() ? fmt::format("none: the SRDF has no {}", noun)
                               : fmt::format("a {} of the SRDF: {}", noun, fmt::join(names, ", ")));
}

/// Adds the members of a group once, however often other groups contain it.
void add_members(const Srdf& srdf, std::string_view key, const std::string& name,
                 std::set<std::string>& seen, GroupChoice& choice) {
  if (!seen.insert(name).second) return;
  const SrdfGroup& group = find_named(srdf.groups, key, name, "group");
  choice.chains.insert(choice.chains.end(), group.chains.begin(), group.chains.end());
  for (const std::string& joint : group.joints) {
    if (!srdf.virtual_joints.contains(joint)) choice.joints.push_back(joint);
  }
  choice.links.insert(choice.links.end(), group.links.begin(), group.links.end());
  for (const std::string& inner : group.groups) add_members(srdf, key, inner, seen, choice);
}

}  // namespace

Srdf read_srdf(const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  const UrdfElement robot = parse_robot(file, document);
  Srdf srdf;
  for (const UrdfElement& pair : robot.children("disable_collisions")) {
    srdf.ignore.emplace_back(text_of(pair, "link1"), text_of(pair, "link2"));
  }
  for (const UrdfElement& state : robot.children("group_state")) {
    auto& positions = srdf.states[text_of(state, "name")];
    for (const UrdfElement& joint : state.children("joint")) {
      // A joint of several axes has several numbers; the base moves by other means.
      const std::string value = text_of(joint, "value");
      if (value.find_first_of(" \t") != std::string::npos) continue;
      positions[text_of(joint, "name")] = joint.number("value");
    }
  }
  for (const UrdfElement& group : robot.children("group")) {
    srdf.groups[text_of(group, "name")] = read_group(group);
  }
  for (const std::string& joint : names_in(robot, "virtual_joint")) {
    srdf.virtual_joints.insert(joint);
  }
  return srdf;
}

GroupChoice choose_group(const Srdf& srdf, std::string_view key, const std::string& name) {
  GroupChoice choice;
  choice.name = name;
  std::set<std::string> seen;
  add_members(srdf, key, name, seen, choice);
  return choice;
}

const std::map<std::string, double>& named_state(const Srdf& srdf, std::string_view key,
                                                 const std::string& name) {
  return find_named(srdf.states, key, name, "named posture");
}

}  // namespace maxwrench
