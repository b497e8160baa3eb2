#pragma once

#include <memory>
#include <vector>

#include "maxwrench/search.h"

namespace maxwrench {

/// Evaluations of one run of a search that is restarted, for d coordinates: about what its local
/// solves need to converge.
constexpr long restart_budget(int d) { return 500L * (d + 1); }

/// Whether more runs of a search are pointless: the Bayesian rule of Boender and Rinnooy Kan
/// (Mathematical Programming 37, 1987, 59-80). If n runs from random starts ended in w different
/// optima, w (n - 1) / (n - w - 2) optima are expected in all. Enough is where that is less than
/// half an optimum above w.
bool enough_restarts(long runs, long optima);

/// Runs a search of its own seed again and again, each with `restart_budget` and from its own
/// random start, until `enough_restarts` or the budget is used: then `stopped` of the result says
/// so. Values that differ by less than 1e-6 (1 + |f|) are one optimum. Runs side by side count as
/// if they took turns, so nothing depends on the threads.
std::unique_ptr<Search> make_restart(const NamedSearch& of);

}  // namespace maxwrench
