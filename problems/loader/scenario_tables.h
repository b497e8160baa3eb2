#pragma once

#include <string>

#include "maxwrench/task.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Reads which wrenches a task asks for: `c`, `set`, `ball` and `hold` of its table `[wrench]`.
void read_wrenches(const Block& wrench, TaskSpec& spec);

/// Reads `[uncertainty]`, `[loss]` and `[payload]` of a task, for the robot of `spec`.
void read_scenario_tables(const Block& task, TaskSpec& spec);

/// What tells tasks apart by these keys, with all digits; empty for a task without them.
std::string words_of_scenarios(const TaskSpec& task);

}  // namespace maxwrench
