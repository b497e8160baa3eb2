#pragma once

#include <string>

#include "maxwrench/problem.h"

namespace maxwrench {

/// Returns, in one line, why proofs in time do not support a task; empty: they do. They support a
/// trajectory or impulse of one contact with at least two knots, a base whose pose has a closed
/// form, a path that rotates about an axis and translates, a wrench along c, and B of full row
/// rank.
std::string why_unprovable(const Problem& problem);

/// Throws std::invalid_argument with that line unless a task is supported.
void require_provable(const Problem& problem);

/// The same for a task that may have a list of scenarios: each is a task of its own, with a wrench.
void require_provable_task(const Problem& problem);

}  // namespace maxwrench
