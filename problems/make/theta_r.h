#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// The joints' names, separated by commas.
std::string names_of(const Robot& robot, const std::vector<int>& joints);

/// Sets the redundant joints, their limits and default, and the guess for the dependent
/// coordinates. `problem` must have its robot, end effector and pose.
void set_joints(const TaskSpec& task, Problem& problem);

/// Rejects values unless there is one number within its limits for each coordinate of theta_r so
/// far.
void require_theta_r_within(std::string_view key, const Eigen::VectorXd& values,
                            const Problem& problem);

/// For a problem with dependent joints. Finds all postures (`Problem::start_system`), and a default
/// and a guess where the task gives none. Rejects a pose that is not reached, and a theta_r that
/// does not fix the posture.
void require_ik_solution(const TaskSpec& task, Problem& problem);

/// For a problem whose second contact has been set since. If the task leaves the default open and
/// the second arm makes the default found so far invalid, searches for another.
void reconsider_default(const TaskSpec& task, Problem& problem);

}  // namespace maxwrench
