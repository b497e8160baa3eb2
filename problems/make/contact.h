#pragma once

#include "maxwrench/problem.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Fills contact, and adds the regrasp coordinates to theta_r, which the joints have filled.
/// Nothing if the task has no such table.
void read_contact(const Block& contact, Problem& problem);

}  // namespace maxwrench
