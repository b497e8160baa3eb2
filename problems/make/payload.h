#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

/// Sets the payload of a task: of a static one in `Problem::scenarios`, with its weight as the only
/// wrench; of a task in time in its `MotionTask`. Rejects the keys of wrenches beside it.
void set_payload(const TaskSpec& task, Problem& problem);

/// Checks the table of wrenches of a task in time, and sets `Problem::c`. Rejects the keys of other
/// wrenches beside it.
void set_table(const TaskSpec& task, Problem& problem);

}  // namespace maxwrench
