#pragma once

#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

struct Answer;
struct Trajectory;
struct TrajectorySolution;

/// The value gained per unit by raising the limits of each effort at block i of a trajectory's
/// program (positive: the upper limit; negative: the lower one), m numbers.
Eigen::VectorXd effort_prices(const Robot& robot, const TrajectorySolution& solution,
                              Eigen::Index i);

/// One line for each of the worst instants of a trajectory that has a value (the peak of an
/// impulse). It lists the limits of efforts, and of their rates there, with significant
/// multipliers, largest effect first.
std::vector<std::string> binding_limits(const Answer& answer);

/// The actuators on whose effort limits a trajectory's value depends most, over all instants,
/// largest effect first. The effect is the multipliers times the width of the limits.
std::string dearest_efforts(const Answer& answer);

/// The joint that is fastest relative to its speed limit at any instant of a trajectory, such as
/// "57 % q3".
std::string fastest_joint(const Robot& robot, const Trajectory& trajectory);

/// The effort that uses the largest share of its limit, such as "98 % thruster_1".
std::string nearest_limit(const Robot& robot, const Eigen::VectorXd& u);

}  // namespace maxwrench
