#pragma once

#include "maxwrench/problem.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Whether the task is a trajectory through the poses of a table, of which the first is its own.
bool follows_poses(const Block& task);

/// Reads `[motion]` and `[path]` of a task in time; nothing of a static one. `problem` has its
/// robot and its pose.
void read_motion(const Block& task, Problem& problem);

/// Reads `[start]` of a heave, which is its default of theta_r, and refuses tasks in time that are
/// not served. `problem` has its theta_r.
void read_start(const Block& task, Problem& problem);

}  // namespace maxwrench
