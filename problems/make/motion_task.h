#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

inline constexpr int kMostKnots = 1000, kMostInstants = 100;
inline constexpr double kLongestLag = 1e3;  ///< of thrusters [s]

/// Rejects values that are not a duration [s].
void require_duration(double T);
/// Rejects a scheme that does not support an impulse or a path.
void require_scheme(const std::string& name, bool impulse);
/// The allowed values of the peak's knot in an impulse.
std::string peak_range(int k);
/// The allowed lags of thrusters.
std::string lag_range();

/// Rejects a robot without an equation of motion.
void require_dynamics(const Robot& robot);

/// Sets the motion of a task in time. `problem` must have its pose.
void set_motion(const TaskSpec& task, Problem& problem);

/// Sets the default of an impulse, at which it starts. `problem` must have its theta_r.
void set_start(const TaskSpec& task, Problem& problem);

}  // namespace maxwrench
