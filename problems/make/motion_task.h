#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

inline constexpr int kMostKnots = 1000, kMostInstants = 100;

/// Rejects what is no duration [s].
void require_duration(double T);
/// Rejects a scheme that does not serve an impulse, or a path.
void require_scheme(const std::string& name, bool impulse);
/// What the knot of an impulse's peak may be.
std::string peak_range(int k);

/// Fills motion of a task in time. `problem` has its pose.
void set_motion(const TaskSpec& task, Problem& problem);

/// The default of an impulse, where it starts. `problem` has its theta_r.
void set_start(const TaskSpec& task, Problem& problem);

}  // namespace maxwrench
