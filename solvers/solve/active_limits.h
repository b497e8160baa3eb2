#pragma once

#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

struct Answer;
struct Trajectory;

/// A line for each of the worst instants of a trajectory that has a value (the peak of an impulse):
/// the limits of efforts, and of their rates there, whose multipliers count, the dearest first.
std::vector<std::string> binding_limits(const Answer& answer);

/// The actuators whose limits of effort a trajectory's value depends on most, over all instants,
/// the dearest first; each by its multipliers times the width of its limits.
std::string dearest_efforts(const Answer& answer);

/// The joint that is fastest beside its speed limit at any instant of a trajectory, such as "57 %
/// q3".
std::string fastest_joint(const Robot& robot, const Trajectory& trajectory);

/// The effort that uses most of its limit, such as "98 % thruster_1".
std::string nearest_limit(const Robot& robot, const Eigen::VectorXd& u);

}  // namespace maxwrench
