#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// The joints' names, separated by commas.
std::string names_of(const Robot& robot, const std::vector<int>& joints);

/// Which joints are redundant, their limits and default, and the guess for those that follow.
/// `problem` has its robot, end effector and pose.
void set_joints(const TaskSpec& task, Problem& problem);

/// Rejects other than one number within its limits for each coordinate of theta_r so far.
void require_theta_r_within(std::string_view key, const Eigen::VectorXd& values,
                            const Problem& problem);

/// Of a problem with dependent joints: finds all postures (`Problem::start_system`), and a default
/// and a guess where the task gives none. Rejects a pose that is not reached, and a theta_r that
/// does not fix the posture.
void require_ik_solution(const TaskSpec& task, Problem& problem);

/// Of one whose second contact has been set since: looks again for a default that the task leaves
/// open, if the second arm makes that which was found invalid.
void reconsider_default(const TaskSpec& task, Problem& problem);

}  // namespace maxwrench
