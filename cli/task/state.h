#pragma once

#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// The names of the robot's velocities: free base axes, then joints.
std::vector<std::string> velocity_names(const Robot& robot);

/// Prints the terms of the equations of motion (eq:dynamics) and J at the state in `file`, as text
/// or, with `json`, as one object; returns the exit status.
int report_state(const Problem& problem, const std::string& file, bool json);

}  // namespace maxwrench
