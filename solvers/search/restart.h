#pragma once

#include <memory>
#include <vector>

#include "maxwrench/search.h"

namespace maxwrench {

/// The evaluations of one run of a restarted search with d coordinates: about what its local solves
/// need to converge.
constexpr long restart_budget(int d) { return 500L * (d + 1); }

/// Whether further runs of a search are unlikely to find another optimum: the Bayesian rule of
/// Boender and Rinnooy Kan (Mathematical Programming 37, 1987, 59-80). If n runs from random starts
/// ended in w different optima, the expected number of all optima is w (n - 1) / (n - w - 2). The
/// runs are enough if this exceeds w by less than half an optimum.
bool enough_restarts(long runs, long optima);

/// Runs a search repeatedly, each time with `restart_budget`. The first run has the search's own
/// seed and start; every other run has its own seed and a random start. Where only one coordinate
/// is free, the second run begins at the peaks of a grid instead. Ends when the budget is
/// used, or at `enough_restarts`; then `stopped` of the result says so. Values that differ by less
/// than 1e-6 (1 + |f|) count as one optimum. Parallel runs count as if they took turns, so the
/// result does not depend on the threads.
std::unique_ptr<Search> make_restart(const NamedSearch& of);

}  // namespace maxwrench
