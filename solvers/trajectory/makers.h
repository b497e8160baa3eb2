#pragma once

#include <memory>

#include "maxwrench/lp_solver.h"
#include "maxwrench/trajectory_program.h"

// Solvers of the programs of trajectories: solvers that exploit the structure, and any general LP
// solver on the assembled program.

namespace maxwrench {

/// A primal-dual interior point method on linear forms of free variables (`Forms`), for which the
/// balance is first solved for the efforts. The homogeneous self-dual embedding (Xu, Hung, Ye) with
/// Mehrotra's predictor and corrector needs no feasible start and ends with an optimum or a proof
/// that there is none. Its normal equations are a chain of small blocks (`NormalMatrix`), so the
/// cost is linear in the number of instants.
///
/// Each call starts cold: the answer depends only on the program. An optimum counts as a verdict
/// only if `recheck` confirms it, residuals and gap alike, to `tolerance` (1 + |value| + price); a
/// proof only if it holds. A search that uses the answer only for a step may request less, e.g.
/// 1e-6, and saves the iterations of the last digits.
std::unique_ptr<TrajectorySolver> make_trajectory_ipm(double tolerance = 1e-9);

/// The same after an attempt on hard max-min programs of one wrench column. Without the rates, the
/// facets give each instant's value, and the least value is the answer if efforts within the rates
/// are found for it. The efforts tried load the most loaded actuator least (`EvenEfforts`), which
/// is enough for slow motions.
std::unique_ptr<TrajectorySolver> make_facets_or_ipm();

/// Any general LP solver on the assembled program, warm-started from call to call while the shape
/// stays the same; or cold each time.
std::unique_ptr<TrajectorySolver> make_assembled_trajectory(std::unique_ptr<LpSolver> solver,
                                                            bool warm = true);

}  // namespace maxwrench
