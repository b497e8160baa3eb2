#include "problems/loader/robot_srdf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "problems/make/bad_value.h"

namespace maxwrench {

RobotSrdf::RobotSrdf(const std::filesystem::path& file) : file_(file.string()) {
  if (!file.empty()) srdf_ = read_srdf(file);
}

void RobotSrdf::choose_group(std::string_view key, const std::string& name,
                             std::string_view key_rest, const std::string& rest,
                             UrdfChoices& choices) const {
  if (name.empty()) return;
  if (!srdf_) throw BadValue(key, shown(name), "an SRDF beside it, which has the group");
  choices.group = maxwrench::choose_group(*srdf_, key, name);
  if (!rest.empty()) choices.group->state = named_state(*srdf_, key_rest, rest);
}

std::map<std::string, double> RobotSrdf::posture(const std::string& name) const {
  if (!srdf_ || !srdf_->states.contains(name)) return {};
  return srdf_->states.at(name);
}

void RobotSrdf::add_to(const UrdfTree& tree, Robot& robot) const {
  if (!srdf_) return;
  robot.files.push_back(file_);
  robot.states = srdf_->states;
  if (!srdf_->groups.empty() && tree.group_tips.empty()) {
    std::vector<std::string> names;
    for (const auto& entry : srdf_->groups) names.push_back(entry.first);
    robot.notes.push_back(
        fmt::format("groups of the SRDF, of which none was chosen: {}", fmt::join(names, ", ")));
  }
  std::set<std::string> unknown;
  for (const auto& [a, b] : srdf_->ignore) {
    for (const std::string& link : {a, b}) {
      if (!tree.bodies.contains(link)) unknown.insert(link);
    }
  }
  if (unknown.empty()) return;
  robot.warnings.push_back(fmt::format("{}: disable_collisions: not in the URDF, so no pair: {}",
                                       file_, fmt::join(unknown, ", ")));
}

}  // namespace maxwrench
