#pragma once

#include <string>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// Sets the wrenches of `Problem::scenarios`, its ball or payload and its unit, and `Problem::c`.
/// Rejects keys of lists in tasks in time.
void set_wrenches(const TaskSpec& task, Problem& problem);

/// A direction that a task states.
struct StatedDirection {
  std::string key, got;  ///< as in files
  Vector6d c;            ///< unit vector in world axes
};

/// The directions of the wrenches and the axes of the ball, after `set_wrenches`.
std::vector<StatedDirection> stated_directions(const TaskSpec& task, const Problem& problem);

/// The basis of what the columns of Y span across these directions.
Matrix6Xd free_across(const std::vector<StatedDirection>& directions, const Matrix6Xd& Y);

/// Sets the limits and loads of `Problem::scenarios`. A task of one wrench and of nothing uncertain
/// has no list.
void set_scenarios(const TaskSpec& task, Problem& problem);

}  // namespace maxwrench
