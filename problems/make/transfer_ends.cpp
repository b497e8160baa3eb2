#include "problems/make/transfer_ends.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/robot/chain.h"
#include "problems/make/bad_value.h"
#include "problems/make/posture.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

/// Rejects the end of a transfer that does not name all joints of the chain, and no others.
void require_all_named(const std::string& key, const std::map<std::string, double>& named,
                       const Robot& robot, const std::vector<int>& chain) {
  const std::string expected = fmt::format(
      "a position for each joint from the base to the end effector: {}", names_of(robot, chain));
  for (const auto& [name, position] : named) {
    const int joint = find_joint(robot, name);
    if (std::find(chain.begin(), chain.end(), joint) != chain.end()) continue;
    throw BadValue(key + "." + name, "an unknown key", expected);
  }
  if (named.size() != chain.size()) {
    throw BadValue(key, fmt::format("{} joints", named.size()), expected);
  }
}

}  // namespace

void set_transfer_ends(const TaskSpec& task, const std::vector<int>& chain, Problem& problem) {
  const Robot& robot = problem.robot;
  problem.redundant = chain;
  const auto count = static_cast<Eigen::Index>(chain.size());
  problem.theta_r_min.resize(count);
  problem.theta_r_max.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(chain[static_cast<std::size_t>(i)])];
    problem.theta_r_min[i] = joint.q_min;
    problem.theta_r_max[i] = joint.q_max;
  }
  MotionTask& motion = *problem.motion;
  require_all_named("from", task.from, robot, chain);
  require_all_named("to", task.to, robot, chain);
  motion.theta_0 = joints_by_name("from.", task.from, robot)(chain);
  motion.theta_T = joints_by_name("to.", task.to, robot)(chain);
  require_theta_r_within("from", motion.theta_0, problem);
  require_theta_r_within("to", motion.theta_T, problem);
  problem.theta_r_default = motion.theta_0;
}

}  // namespace maxwrench
