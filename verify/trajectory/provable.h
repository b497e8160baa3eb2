#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// Throws std::invalid_argument, in one line, unless the task is one that proofs in time support: a
/// trajectory or impulse of one contact with at least two knots, a base whose pose has a closed
/// form, a path that rotates about an axis and translates, a wrench along c, and B of full row
/// rank.
void require_provable(const Problem& problem);

/// The same for a task that may have a list of scenarios: each is a task of its own, with a wrench.
void require_provable_task(const Problem& problem);

}  // namespace maxwrench
