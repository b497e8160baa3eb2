#pragma once

#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

struct PlanRow;

/// A line for each of the worst instants of a plan that has a value (the peak of a heave): the
/// limits of efforts, and of their rates there, whose multipliers count, the dearest first.
std::vector<std::string> binding_limits(const Robot& robot, const PlanRow& row);

/// The effort that uses most of its limit, such as "98 % thruster_1".
std::string nearest_limit(const Robot& robot, const Eigen::VectorXd& u);

}  // namespace maxwrench
