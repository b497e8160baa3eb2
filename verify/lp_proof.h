#pragma once

#include <gmpxx.h>

#include <string>
#include <vector>

#include "maxwrench/linear_program.h"

namespace maxwrench {

using RationalVector = std::vector<mpq_class>;

/// A verdict of a linear program in rational numbers, with what proves it.
struct LpProof {
  Status status = Status::kNumericalError;  ///< kOptimal, kInfeasible or kUnbounded
  RationalVector x;       ///< cols; a feasible point, but of an infeasible program
  RationalVector lambda;  ///< rows; of an optimum
  /// `LpSolution::certificate`: y (rows) of an infeasible program, r (cols) of an unbounded one.
  RationalVector certificate;
};

/// Empty if the verdict follows, without any tolerance, from the program's numbers as the doubles
/// that they are; else what does not hold. Optimal: A x = b, l <= x <= u, and d = c - A'lambda is
/// positive only where x = u, negative only where x = l. Infeasible: sup {y'A x : l <= x <= u} <
/// y'b, or some l > u. Unbounded: x is feasible, A r = 0, r leaves no bound, c'r > 0. Bounds from
/// 1e20 on count as infinite.
std::string reject_lp_proof(const LinearProgram& program, const LpProof& proof);

/// c'x.
mpq_class exact_objective(const LinearProgram& program, const RationalVector& x);

}  // namespace maxwrench
