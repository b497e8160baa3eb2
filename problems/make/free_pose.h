#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

/// Appends the coordinates of the pose that a static task leaves free to theta_r, which must
/// already hold the joints. Rejects free coordinates in a task in time.
void set_free_pose(const TaskSpec& task, Problem& problem);

/// Rejects free coordinates along which the end effector cannot move, and those along which the set
/// of wrenches that do work changes. `problem` must have its start system.
void require_free_motions(const TaskSpec& task, const Problem& problem);

}  // namespace maxwrench
