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

/// Of a problem with dependent joints: finds all postures (`Problem::atlas`), and a default and a
/// guess where the task gives none. Refuses a pose that is not reached, and a theta_r that does not
/// fix the posture.
void require_branch(const Block& task, Problem& problem);

/// Of one whose second contact has been read since: looks again for a default that the task leaves
/// open, if the second arm makes that which was found invalid.
void reconsider_default(const Block& task, Problem& problem);

}  // namespace maxwrench
