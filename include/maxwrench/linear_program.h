#pragma once

#include <Eigen/Sparse>
#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

namespace maxwrench {

/// max c'x  subject to  A x = b,  l <= x <= u.
///
/// A rows×cols is compressed by columns; l and u may be infinite or equal. Crossing bounds are an
/// infeasible program. Names are optional (empty or one for each).
struct LinearProgram {
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd b, c, l, u;
  std::vector<std::string> row_names, col_names;

  int rows() const { return static_cast<int>(A.rows()); }
  int cols() const { return static_cast<int>(A.cols()); }
};

enum class VariableState : signed char { kAtLower, kAtUpper, kFree, kBasic };

/// The answer of an `LpSolver`. It is also its storage and its warm start: pass the same object
/// again.
struct LpSolution : Verdict {
  Eigen::VectorXd x;       ///< cols
  Eigen::VectorXd lambda;  ///< rows, d(objective)/db
  /// Proof of a verdict that has no optimum. Infeasible: y (rows) with sup {y'A x : l <= x <= u} <
  /// y'b. Unbounded: a ray r (cols) with A r = 0 that leaves no bound and c'r > 0 (x is then a
  /// feasible point).
  Eigen::VectorXd certificate;
  double objective = 0;
  int iterations = 0;
  /// One state for each column, then one for each row's logical variable; empty: cold start.
  std::vector<VariableState> basis;
  int cold_restarts = 0;  ///< times the kept basis was thrown away
};

/// Storage that makes repeated verification free of allocation.
struct LpScratch {
  Eigen::VectorXd sum, size;
};

/// Throws std::invalid_argument if the sizes disagree, an entry is NaN, A, b or c is not finite, or
/// a bound excludes every number (l = +infinity, u = -infinity).
void validate(const LinearProgram& program);

/// What solvers answer to a program that no solver should have been given.
inline constexpr const char* kMalformed =
    "the program is malformed: sizes disagree or an entry is not finite";

/// Figures recomputed from the program's data, never taken from a solver's word: balance A x - b,
/// bounds of x, dual: sign violations of d = c - A'lambda where the bound is infinite, gap
/// |lambda'b + sup {d'x : l <= x <= u} - c'x|. Each is scaled by one plus the largest magnitude of
/// the terms that it compares.
///
/// Bounds from 1e20 on count as infinite. A sum that rounding alone could have produced (a few
/// units in the last place of its terms) counts as zero, so that it is not multiplied by a large
/// bound. What cannot be computed (wrong sizes, NaN) is an infinite residual.
Residual residuals(const LinearProgram& program, const LpSolution& solution);
Residual residuals(const LinearProgram& program, const LpSolution& solution, LpScratch& scratch);

/// Whether the status follows from the data: residuals below `tolerance` when optimal, a
/// certificate that proves it when infeasible or unbounded. Any other status is no verdict: false.
///
/// A certificate is judged relative to its own terms, so its length does not matter. Infeasible:
/// y'b exceeds the supremum by 1e-10 of the sum of all magnitudes, far above rounding, and by what
/// rounding of (A'y)_j makes of the bounds; (A'y)_j below 1e-10 of the magnitudes it is summed from
/// counts as zero where the bound is infinite; any l > u is a proof by itself. Unbounded: A r
/// vanishes and bounds are kept to 1e-9 of the terms, c'r exceeds 1e-9 of its terms, and x is
/// feasible to `tolerance`.
bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance = 1e-7);
bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance,
              LpScratch& scratch);

/// Sets the entries of a certificate to zero that are rounding beside its largest one: in a row or
/// column where no other entry counts they would spoil the proof.
void drop_rounding(Eigen::VectorXd& certificate);

}  // namespace maxwrench
