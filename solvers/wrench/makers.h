#pragma once

#include <memory>

#include "maxwrench/lp_solver.h"
#include "maxwrench/wrench_solver.h"

// Solvers of wrench programs: solvers that exploit the structure, and any general LP solver on the
// assembled program.

namespace maxwrench {

/// One wrench column a = J'W by ray shooting through the facet pairs of {B u}: with w = x,
///
///     b_min <= N'(tau_d + a x) <= b_max
///
/// bounds x from both sides, pair by pair. The optimum is the tightest bound on the side of c_w,
/// and lambda = -c_w n_j / (n_j'a) of the active pair. There are no pivots or iterations. Throws
/// std::invalid_argument on several columns or a zonotope without facets.
std::unique_ptr<WrenchSolver> make_facets();

/// Any number of wrench columns, by a small dual simplex that starts at a sign vertex (`Tableau`).
/// If the free columns are as many as the rows without a direct drive, they are eliminated, and the
/// efforts of the thrusters remain (`Elimination`). Otherwise the efforts are eliminated, by the
/// facet pairs of {B u}:
///
///     max c_w'w   subject to   b_min - N'tau_d <= N'J'W w <= b_max - N'tau_d,   w_min <= w <=
///     w_max
///
/// with lambda = -N_B y_B. A directly driven joint gives one of these rows, as does a direction
/// that no actuator reaches.
///
/// Each call starts cold by the same rule: the answer depends only on the program. These go to the
/// general simplex on the assembled program, also cold: programs that have no facets and cannot be
/// eliminated, a wrench that loads no actuator, and answers that fail the checks.
std::unique_ptr<WrenchSolver> make_condensed();

/// Any general LP solver on the assembled program, warm-started from call to call; or cold each
/// time, so that an answer does not depend on earlier calls.
std::unique_ptr<WrenchSolver> make_assembled(std::unique_ptr<LpSolver> solver, bool warm = true);

}  // namespace maxwrench
