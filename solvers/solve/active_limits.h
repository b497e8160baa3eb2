#pragma once

#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

struct Answer;
struct Plan;

/// A line for each of the worst instants of a plan that has a value (the peak of a heave): the
/// limits of efforts, and of their rates there, whose multipliers count, the dearest first.
std::vector<std::string> binding_limits(const Answer& answer);

/// The actuators whose limits of effort a plan's value depends on most, over all instants, the
/// dearest first; each by its multipliers times the width of its limits.
std::string dearest_efforts(const Answer& answer);

/// The joint that is fastest beside its speed limit at any instant of a plan, such as "57 % q3".
std::string fastest_joint(const Robot& robot, const Plan& plan);

/// The effort that uses most of its limit, such as "98 % thruster_1".
std::string nearest_limit(const Robot& robot, const Eigen::VectorXd& u);

}  // namespace maxwrench
