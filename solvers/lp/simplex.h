#pragma once

#include <memory>

#include "lib/lp_solver.h"

namespace maxwrench {

/// Every tolerance of the simplex. They apply to the scaled program.
struct SimplexOptions {
  double primal_tolerance = 1e-9;     ///< bound violation of a feasible basis, beside rounding
  double dual_tolerance = 1e-9;       ///< sign violation of a reduced cost, largest cost near 1
  double zero_tolerance = 1e-9;       ///< smaller entries of the tableau are no pivots
  double pivot_tolerance = 1e-7;      ///< smaller pivots are only taken from fresh factors
  double singular_tolerance = 1e-10;  ///< smaller pivots make a basis singular
  double verify_tolerance = 1e-7;     ///< residuals, from the data, of an accepted optimum
  int max_updates = 64;               ///< pivots between two factorisations
  int max_iterations = 0;             ///< pivots and bound flips; 0: 2,000 + 20 (rows + columns)
};

/// A bounded-variable simplex for `max c'x, A x = b, l <= x <= u`; dense factors, so meant for up
/// to about 500 × 1,000.
///
/// A basis that is dual feasible, if need be after moving boxed variables to their other bound, is
/// repaired by the dual simplex; one that is primal feasible is improved by the primal simplex; one
/// that is neither goes through a first phase: the dual simplex on costs shifted until the basis is
/// dual feasible, which ends in a feasible basis or a proof that there is none. A solution with a
/// `basis` that fits is a warm start. After the first call a warm start of the same sizes allocates
/// nothing. Same program and same basis: same answer, bit for bit.
std::unique_ptr<LpSolver> make_simplex(const SimplexOptions& options = {});

}  // namespace maxwrench
