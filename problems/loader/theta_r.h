#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/problem.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// The joints' names, separated by commas.
std::string names_of(const Robot& robot, const std::vector<int>& joints);

/// Reads `[theta_r]`: which joints are redundant, their default, and the guess for those that
/// follow. `problem` has its robot, end effector and pose.
void read_theta_r(const Block& theta_r, Problem& problem);

/// The value of a key: a number within its limits for each joint of theta_r, which are in
/// `problem`.
Eigen::VectorXd limited_theta_r(const Block& block, std::string_view key, const Problem& problem);

/// Refuses a task whose pose is not reached from the guess, or whose theta_r does not fix the
/// posture there.
void require_branch(const Block& task, const Problem& problem);

}  // namespace maxwrench
