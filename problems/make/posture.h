#pragma once

#include <map>
#include <string>
#include <string_view>

#include "maxwrench/task.h"

namespace maxwrench {

/// The positions of a named posture of the robot, without those of joints that do not move or that
/// a gear moves. Rejects other names, as a value of `key`.
std::map<std::string, double> named_posture(const Robot& robot, std::string_view key,
                                            const std::string& name);

/// The positions of all joints in the posture of a task. Rejects names that are not of joints that
/// move.
Eigen::VectorXd joints_at_posture(const TaskSpec& task);

/// The positions of all joints from those of some, by name, whose key begins with `key`. Others
/// rest.
Eigen::VectorXd joints_by_name(const std::string& key, const std::map<std::string, double>& named,
                               const Robot& robot);

/// Makes a static task at the pose of some posture, for whoever gives none: that at rest if the end
/// effector can move from there in all its directions without a collision; else, of random
/// postures in the middle half of the joints' limits, the one from which it moves best.
///
/// @throws BadValue as `make_problem` for the posture at rest, if no posture suits the task.
Problem make_at_some_posture(TaskSpec task);

/// The same at a posture that is a good example: away from the joints' limits, with the end
/// effector in front of the base if a posture has it there.
Problem make_at_good_posture(TaskSpec task);

}  // namespace maxwrench
