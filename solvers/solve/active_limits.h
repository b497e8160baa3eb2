#pragma once

#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

struct Answer;
struct Instant;
struct Trajectory;
struct TrajectoryProgram;
struct TrajectorySolution;

/// The value gained per unit by raising the limits of each effort at block i of a trajectory's
/// program (positive: the upper limit; negative: the lower one), m numbers.
Eigen::VectorXd effort_prices(const Robot& robot, const TrajectoryProgram& program,
                              const TrajectorySolution& solution, Eigen::Index i);

/// The instant of block i of a trajectory's program, and the scenario of the block; "" without a
/// list.
const Instant& instant_of_block(const Answer& answer, Eigen::Index i);
std::string scenario_of_block(const Answer& answer, Eigen::Index i);

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

/// The effort that uses the largest share of its limit in a set, such as "98 % thruster_1".
std::string nearest_limit(const Robot& robot, const Zonotope& set, const Eigen::VectorXd& u);

/// The limits of the efforts that an answer in time reports: those of the scenario that decides.
const Zonotope& reported_limits(const Answer& answer);

}  // namespace maxwrench
