#pragma once

#include <memory>

#include "maxwrench/lp_solver.h"

// Solvers of general linear programs.

namespace maxwrench {

/// All tolerances of the simplex. They apply to the scaled program.
struct SimplexOptions {
  double primal_tolerance = 1e-9;     ///< bound violation of a feasible basis, apart from rounding
  double dual_tolerance = 1e-9;       ///< sign violation of a reduced cost, largest cost near 1
  double zero_tolerance = 1e-9;       ///< smaller entries of the tableau are no pivots
  double pivot_tolerance = 1e-7;      ///< smaller pivots are only taken from fresh factors
  double singular_tolerance = 1e-10;  ///< smaller pivots make a basis singular
  double verify_tolerance = 1e-7;     ///< residuals of an accepted optimum, from the data
  int max_updates = 64;               ///< pivots between two factorisations
  int max_iterations = 0;             ///< pivots and bound flips; 0: 2,000 + 20 (rows + columns)
};

/// A bounded-variable simplex for `max c'x, A x = b, l <= x <= u`. From 600 rows on, a program
/// with at most a tenth of non-zero entries gets sparse factors. Others are meant to be up to about
/// 500 × 1,000.
///
/// A basis that is dual feasible, if necessary after boxed variables move to their other bound, is
/// repaired by the dual simplex. A basis that is primal feasible is improved by the primal simplex.
/// A basis that is neither goes through a first phase: the dual simplex on costs shifted until the
/// basis is dual feasible. With sparse factors, it first looks for a basis that needs no shifts.
/// The phase ends with a feasible basis or a proof that there is none. A solution with a `basis`
/// that fits is a warm start. After the first call, a warm start of the same sizes allocates
/// nothing, unless its factors are sparse. The same program and the same basis give the same
/// answer, bit for bit.
std::unique_ptr<LpSolver> make_simplex(const SimplexOptions& options = {});

/// Clp, COIN-OR's simplex library, silent: the dual simplex with bounds and costs unperturbed.
/// Every call loads the program anew and then the stored basis. Its rays are the proofs; where it
/// has none, `prove_no_optimum` finds one.
std::unique_ptr<LpSolver> make_clp();

/// The same on one model that is edited in place from call to call while the pattern of A stays,
/// with its own basis (for benchmarks: the least work that Clp needs).
std::unique_ptr<LpSolver> make_clp_keeping_its_model();

/// The first method of Clp: its dual simplex, its primal simplex, or the one that it chooses after
/// presolving. The latter two scale.
enum class ClpMethod { kDual, kPrimal, kPresolved };

/// The same by another method (for benchmarks: no single setting suits all large programs).
std::unique_ptr<LpSolver> make_clp_by(ClpMethod method);

/// GLPK's dual simplex, silent. Every call loads the program anew and then the stored basis,
/// because editing and re-solving has returned an "optimum" with wrong residuals. GLPK's
/// environment belongs to a thread, so problems exist only during a call. If a host program uses
/// GLPK in the same thread, its environment is left unchanged, except for its terminal and error
/// hooks. A Farkas vector is a row of the inverse basis; a ray comes from `prove_no_optimum`.
std::unique_ptr<LpSolver> make_glpk();

/// The same on one problem that is edited in place from call to call (for benchmarks). The thread
/// that uses it must also destroy it.
std::unique_ptr<LpSolver> make_glpk_keeping_its_model();

/// Ipopt, a general interior point method, with settings for linear programs (Mehrotra's
/// predictor-corrector, no relaxed bounds). When it does not converge, the elastic program (least
/// 1-norm of A x - b) decides whether the program is infeasible: its multipliers are the Farkas
/// vector. Debian's build is not thread-safe, so one lock serialises all solves in a process.
std::unique_ptr<LpSolver> make_ipopt();

}  // namespace maxwrench
