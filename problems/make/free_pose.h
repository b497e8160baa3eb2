#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

/// Adds the coordinates of the pose that a static task leaves free to theta_r, which the joints
/// have filled. A task in time is rejected them.
void set_free_pose(const TaskSpec& task, Problem& problem);

/// Rejects coordinates along which the end effector cannot move, and those along which the wrenches
/// that do work change. `problem` has its start system.
void require_free_motions(const TaskSpec& task, const Problem& problem);

}  // namespace maxwrench
