#include "problems/loader/joint_group.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

[[noreturn]] void reject(const GroupChoice& group, const std::string& expected) {
  throw BadValue("group", shown(group.name), expected);
}

bool has_type(const UrdfElement& joint, const char* type) {
  return joint.attribute("type") == std::optional<std::string>(type);
}

/// The joints of a group, and the links that they move to.
class Members {
 public:
  Members(const UrdfStructure& structure, const GroupChoice& group)
      : structure_(structure), group_(group) {
    for (const UrdfElement& joint : structure.joints) {
      joint_to_.emplace(end_of(joint, "child"), &joint);
      joints_.emplace(name_of(joint), &joint);
    }
    for (const auto& [base, tip] : group.chains) add_chain(base, tip);
    for (const std::string& name : group.joints) add_joint(name);
    for (const std::string& name : group.links) add_link(name);
  }

  const std::set<std::string>& joints() const { return members_; }

  /// The links of the group that carry no other link of it, in the order of the group: those that
  /// its joints move, or all of them if it moves none.
  std::vector<std::string> tips() const {
    std::set<std::string> carriers;
    for (const std::string& link : ends_) {
      const std::vector<std::string> path = path_to(link);
      carriers.insert(path.begin() + 1, path.end());
    }
    std::vector<std::string> tips, moved;
    std::set<std::string> seen;
    for (const std::string& link : ends_) {
      if (carriers.contains(link) || !seen.insert(link).second) continue;
      tips.push_back(link);
      if (is_moved(link)) moved.push_back(link);
    }
    return moved.empty() ? tips : moved;
  }

 private:
  const UrdfElement* joint_to(const std::string& link) const {
    const auto found = joint_to_.find(link);
    return found == joint_to_.end() ? nullptr : found->second;
  }

  void require_link(const std::string& name) const {
    if (structure_.links.contains(name)) return;
    reject(group_, fmt::format("a group of links of the URDF, which has no '{}'", name));
  }

  /// The links from this one to the root.
  std::vector<std::string> path_to(const std::string& link) const {
    std::vector<std::string> path = {link};
    while (const UrdfElement* joint = joint_to(path.back())) {
      path.push_back(end_of(*joint, "parent"));
    }
    return path;
  }

  bool is_moved(const std::string& link) const {
    const std::vector<std::string> path = path_to(link);
    return std::any_of(path.begin(), path.end(), [this](const std::string& at) {
      const UrdfElement* joint = joint_to(at);
      return joint && !has_type(*joint, "fixed") && members_.contains(name_of(*joint));
    });
  }

  /// The joints between two links, which may lead through a link that carries both.
  void add_chain(const std::string& base, const std::string& tip) {
    require_link(base);
    require_link(tip);
    std::vector<std::string> from = path_to(base), to = path_to(tip);
    while (!from.empty() && !to.empty() && from.back() == to.back()) {
      from.pop_back();
      to.pop_back();
    }
    for (const auto* links : {&from, &to}) {
      for (const std::string& link : *links) members_.insert(name_of(*joint_to(link)));
    }
    ends_.push_back(tip);
  }

  void add_joint(const std::string& name) {
    const auto found = joints_.find(name);
    if (found == joints_.end()) {
      reject(group_, fmt::format("a group of joints of the URDF, which has no '{}'", name));
    }
    members_.insert(name);
    ends_.push_back(end_of(*found->second, "child"));
  }

  void add_link(const std::string& name) {
    require_link(name);
    if (const UrdfElement* joint = joint_to(name)) members_.insert(name_of(*joint));
    ends_.push_back(name);
  }

  const UrdfStructure& structure_;
  const GroupChoice& group_;
  std::map<std::string, const UrdfElement*> joint_to_, joints_;
  std::set<std::string> members_;
  std::vector<std::string> ends_;
};

/// Where the group has a joint outside of it; nothing: the group does not say.
std::optional<double> position_outside(const GroupChoice& group, const std::string& joint) {
  for (const auto* positions : {&group.rest, &group.state}) {
    const auto found = positions->find(joint);
    if (found != positions->end()) return found->second;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> lock_outside_of_group(const UrdfStructure& structure, UrdfChoices& choices,
                                               std::vector<std::string>& notes) {
  const GroupChoice& group = *choices.group;
  const Members members(structure, group);
  std::vector<std::string> moving, placed;
  std::set<std::string> outside;
  int at_rest = 0;
  for (const UrdfElement& joint : structure.joints) {
    if (has_type(joint, "fixed")) continue;
    const std::string name = name_of(joint);
    if (members.joints().contains(name)) {
      moving.push_back(name);
      continue;
    }
    JointChoice& choice = choices.joints[name];
    const bool follows = choice.mimic || joint.child_if_any("mimic").has_value();
    if (follows && !choice.lock) continue;
    outside.insert(name);
    if (choice.lock) continue;
    choice.lock = position_outside(group, name);
    choice.rest_given = group.rest.contains(name);
    choice.rests = !choice.lock;
    if (choice.lock) {
      placed.push_back(fmt::format("{}={:g}", name, *choice.lock));
    } else {
      ++at_rest;
    }
  }
  if (moving.empty()) reject(group, "a group with a joint that moves");
  for (const auto& [joint, position] : group.rest) {
    if (outside.contains(joint)) continue;
    throw BadValue("rest", shown(joint),
                   fmt::format("a joint outside of the group {}", group.name));
  }
  std::string note = fmt::format("group {}: joints {}", group.name, fmt::join(moving, ", "));
  if (!placed.empty()) note += fmt::format("; locked at {}", fmt::join(placed, ", "));
  if (at_rest > 0) note += fmt::format("; {} locked at rest", at_rest);
  notes.push_back(note);
  return members.tips();
}

}  // namespace maxwrench
