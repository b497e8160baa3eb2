#pragma once

#include "maxwrench/task.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Whether the task is a trajectory through the poses of a table. The first pose is then the task's
/// pose.
bool follows_poses(const Block& task);

/// Reads `[motion]`, and `[path]` or `[start]`, of a task in time. Does nothing for a static task.
/// `spec` must have its pose.
void read_motion(const Block& task, TaskSpec& spec);

}  // namespace maxwrench
