#pragma once

#include "maxwrench/task.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Whether the task is a trajectory through the poses of a table, of which the first is its own.
bool follows_poses(const Block& task);

/// Reads `[motion]` and `[path]` or `[start]` of a task in time; nothing of a static one. `spec`
/// has its pose.
void read_motion(const Block& task, TaskSpec& spec);

}  // namespace maxwrench
