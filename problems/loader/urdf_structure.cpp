#include "problems/loader/urdf_structure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "problems/loader/bad_input.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// The element <robot>.
UrdfElement parse(const fs::path& file, tinyxml2::XMLDocument& document) {
  std::ifstream stream = open_file(file, "a URDF file");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  document.Parse(text.c_str());
  if (document.Error()) {
    const bool deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
    throw_bad_input(file, fmt::format("line {}", document.ErrorLineNum()),
                    deep ? fmt::format("an element within {} others", TINYXML2_MAX_ELEMENT_DEPTH)
                         : fmt::format("'{}'", document.ErrorName()),
                    deep ? "a file with less nesting" : "valid XML");
  }
  const tinyxml2::XMLElement* xml = document.FirstChildElement("robot");
  if (xml == nullptr) throw_bad_input(file, "robot", "nothing", "an element <robot>");
  if (xml->NextSiblingElement("robot") != nullptr)
    throw_bad_input(file, "robot", "two", "one robot");
  const UrdfElement robot(file, *xml, "robot");
  if (!robot.attribute("name")) robot.throw_bad_input("name", "nothing", "a name");
  const std::string version = robot.attribute("version").value_or("1.0");
  if (version != "1.0") robot.throw_bad_input("version", fmt::format("'{}'", version), "1.0");
  return robot;
}

/// The links or joints by name.
std::map<std::string, UrdfElement> named_elements(const UrdfElement& robot, const char* tag) {
  std::map<std::string, UrdfElement> found;
  for (const UrdfElement& each : robot.children(tag)) {
    const UrdfElement element = each.with_name();
    if (found.emplace(name_of(element), element).second) continue;
    element.throw_bad_input("", "a duplicate name", "unique names");
  }
  return found;
}

/// The parent of each link.
std::map<std::string, std::string> find_parents(const std::map<std::string, UrdfElement>& links,
                                                const std::map<std::string, UrdfElement>& joints) {
  std::map<std::string, std::string> parents, joint_to;
  for (const auto& [name, joint] : joints) {
    for (const char* end : {"parent", "child"}) {
      if (links.contains(end_of(joint, end))) continue;
      joint.child(end).throw_bad_input("link", fmt::format("'{}'", end_of(joint, end)),
                                       "a link of this file");
    }
    const std::string child = end_of(joint, "child");
    if (!parents.emplace(child, end_of(joint, "parent")).second) {
      joint.child("child").throw_bad_input(
          "link", fmt::format("'{}'", child),
          fmt::format("a link that no other joint leads to ('{}' does)", joint_to.at(child)));
    }
    joint_to.emplace(child, name);
  }
  return parents;
}

/// The link without a parent. Rejects links that it does not lead to.
std::string find_root(const fs::path& file, const std::map<std::string, UrdfElement>& links,
                      const std::map<std::string, std::string>& parents) {
  std::vector<std::string> roots;
  for (const auto& [name, link] : links) {
    if (!parents.contains(name)) roots.push_back(name);
  }
  if (roots.size() != 1) {
    throw_bad_input(
        file, "link",
        roots.empty() ? "a joint to every link" : fmt::format("roots {}", fmt::join(roots, ", ")),
        "one root: one link that no joint leads to");
  }
  const std::string& root = roots.front();
  for (const auto& [name, link] : links) {
    std::string at = name;
    for (std::size_t steps = 0; at != root && steps < links.size(); ++steps) at = parents.at(at);
    if (at == root) continue;
    link.throw_bad_input("", "a loop of joints",
                         fmt::format("a tree: joints that lead here from the root '{}'", root));
  }
  return root;
}

}  // namespace

std::string name_of(const UrdfElement& element) { return element.attribute("name").value(); }

std::string end_of(const UrdfElement& joint, const char* end) {
  const UrdfElement element = joint.child(end);
  const std::optional<std::string> link = element.attribute("link");
  if (!link) element.throw_bad_input("link", "nothing", "a link of this file");
  return *link;
}

UrdfStructure read_structure(const fs::path& file, tinyxml2::XMLDocument& document) {
  constexpr std::size_t kMostLinks = 1000;
  const UrdfElement robot = parse(file, document);
  UrdfStructure structure;
  structure.links = named_elements(robot, "link");
  const std::size_t count = structure.links.size();
  if (count == 0) throw_bad_input(file, "link", "nothing", "one link or more");
  if (count > kMostLinks) {
    throw_bad_input(file, "link", fmt::format("{} links", count),
                    fmt::format("at most {}", kMostLinks));
  }
  const auto joints = named_elements(robot, "joint");
  structure.root = find_root(file, structure.links, find_parents(structure.links, joints));
  for (const UrdfElement& joint : robot.children("joint")) {
    structure.joints_from[end_of(joint, "parent")].push_back(joint.with_name());
  }
  return structure;
}

}  // namespace maxwrench
