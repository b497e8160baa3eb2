#pragma once

#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// Sets theta_r and the two ends of a transfer, which moves all joints of the chain from one given
/// posture to another. Rejects an end that does not name all of them, and no others.
void set_transfer_ends(const TaskSpec& task, const std::vector<int>& chain, Problem& problem);

}  // namespace maxwrench
