#pragma once

#include <memory>

#include "maxwrench/lp_solver.h"
#include "maxwrench/trajectory_program.h"

// Solvers of the programs of trajectories: one that knows the structure, and any other on the
// assembled program.

namespace maxwrench {

/// A primal-dual interior point method on linear forms of free variables (`Forms`): the balance is
/// solved for the efforts beforehand. The homogeneous self-dual embedding (Xu, Hung, Ye) with
/// Mehrotra's predictor and corrector needs no feasible start and ends in an optimum or in a proof
/// that there is none. Its normal equations are a chain of small blocks (`NormalMatrix`): a cost
/// linear in the number of instants.
///
/// Each call starts cold: the answer depends on nothing but the program. An optimum that `recheck`
/// does not confirm to `tolerance` (1 + |value| + price), residuals and gap alike, and a proof that
/// does not hold are no verdicts. A search that only steps by the answer may ask for less, e.g.
/// 1e-6: the iterations of the last digits are saved.
std::unique_ptr<TrajectorySolver> make_trajectory_ipm(double tolerance = 1e-9);

/// The same after an attempt on hard max-min programs of one wrench column: without the rates each
/// instant's value is found by its facets, and the least is the answer if efforts that keep the
/// rates are found for it. They are sought where the most loaded actuator is loaded least
/// (`EvenEfforts`), which is enough for slow motions.
std::unique_ptr<TrajectorySolver> make_facets_or_ipm();

/// Any general LP solver on the assembled program, warm-started from call to call while the shape
/// stays; or cold each time.
std::unique_ptr<TrajectorySolver> make_assembled_trajectory(std::unique_ptr<LpSolver> solver,
                                                            bool warm = true);

}  // namespace maxwrench
