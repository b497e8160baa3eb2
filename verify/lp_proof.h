#pragma once

#include <gmpxx.h>

#include <string>
#include <vector>

#include "maxwrench/linear_program.h"

namespace maxwrench {

using RationalVector = std::vector<mpq_class>;

/// The status of a linear program in rational numbers, with its proof.
struct LpProof {
  Status status = Status::kNumericalError;  ///< kOptimal, kInfeasible or kUnbounded
  RationalVector x;       ///< cols; a feasible point, unless the program is infeasible
  RationalVector lambda;  ///< rows; only at an optimum
  /// `LpSolution::certificate`: y (rows) of an infeasible program, r (cols) of an unbounded one.
  RationalVector certificate;
};

/// Empty if the status follows, without any tolerance, from the program's numbers taken as exact
/// doubles; otherwise the condition that is violated. Optimal: A x = b, l <= x <= u, and d = c -
/// A'lambda is positive only where x = u and negative only where x = l. Infeasible: sup {y'A x : l
/// <= x <= u} < y'b, or some l > u. Unbounded: x is feasible, A r = 0, r stays within the bounds at
/// any length, c'r > 0. Bounds of magnitude 1e20 or more count as infinite.
std::string reject_lp_proof(const LinearProgram& program, const LpProof& proof);

/// c'x.
mpq_class exact_objective(const LinearProgram& program, const RationalVector& x);

}  // namespace maxwrench
