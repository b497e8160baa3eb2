#pragma once

#include <Eigen/Sparse>
#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

/// @file
/// Linear programs, their solutions and the verification of these solutions.

namespace maxwrench {

/// The linear program max c'x subject to A x = b, l <= x <= u.
///
/// A program whose bounds cross (l > u) is infeasible.
struct LinearProgram {
  Eigen::SparseMatrix<double> A;       ///< matrix (rows×cols), compressed by columns
  Eigen::VectorXd b,                   ///< right-hand side (rows)
      c,                               ///< objective (cols)
      l,                               ///< lower bounds (cols); may be infinite, or equal to u
      u;                               ///< upper bounds (cols); may be infinite, or equal to l
  std::vector<std::string> row_names,  ///< optional: empty, or one name for each row
      col_names;                       ///< optional: empty, or one name for each column

  int rows() const { return static_cast<int>(A.rows()); }  ///< Returns the number of rows.
  int cols() const { return static_cast<int>(A.cols()); }  ///< Returns the number of columns.
};

/// The state of a variable in a basis of the simplex method.
enum class VariableState : signed char {
  kAtLower,  ///< nonbasic, at its lower bound
  kAtUpper,  ///< nonbasic, at its upper bound
  kFree,     ///< nonbasic, without bounds
  kBasic     ///< basic
};

/// The result of an `LpSolver`, with its storage and its warm start.
///
/// Pass the same object again to reuse both.
struct LpSolution : Verdict {
  Eigen::VectorXd x;       ///< point (cols)
  Eigen::VectorXd lambda;  ///< multipliers d(objective)/db (rows)
  /// The proof of an infeasible or unbounded program.
  ///
  /// Infeasible: y (rows) with sup {y'A x : l <= x <= u} < y'b. Unbounded: a ray r (cols) with
  /// A r = 0 that violates no bound, and c'r > 0. Then x is a feasible point.
  Eigen::VectorXd certificate;
  double objective = 0;  ///< c'x
  int iterations = 0;    ///< iterations of the solver
  /// One state for each column, then one for the logical variable of each row. Empty: cold start.
  std::vector<VariableState> basis;
  int cold_restarts = 0;  ///< how often the solver discarded the stored basis
};

/// Storage for `verified` and `residuals`, so that repeated calls allocate nothing.
struct LpScratch {
  Eigen::VectorXd sum,  ///< sums of terms
      size;             ///< sums of their magnitudes
};

/// Checks the data of a linear program.
///
/// @throws std::invalid_argument if the sizes disagree, an entry is NaN, an entry of A, b or c is
///         not finite, or a bound excludes every number (l = +infinity, u = -infinity).
void validate(const LinearProgram& program);

/// The reason that solvers give if the program is malformed.
inline constexpr const char* kMalformed =
    "the program is malformed: sizes disagree or an entry is not finite";

/// Computes the residual of a solution from the data of the program.
///
/// It uses no number that the solver reports about its own accuracy. Balance: A x - b. Bounds: the
/// violations of the bounds by x. Dual: wrong signs of d = c - A'lambda where the bound is
/// infinite. Gap: |lambda'b + sup {d'x : l <= x <= u} - c'x|. Each is divided by one plus the
/// largest magnitude of the terms that it compares.
///
/// Bounds of magnitude 1e20 or more count as infinite. A sum that rounding alone may have produced
/// (a few units in the last place of its terms) counts as zero. Otherwise a large bound would
/// multiply it.
///
/// @param program   the program
/// @param solution  its solution
/// @return the residual; infinite where it cannot be computed (wrong sizes, NaN)
Residual residuals(const LinearProgram& program, const LpSolution& solution);
/// Does the same in storage that the caller provides.
Residual residuals(const LinearProgram& program, const LpSolution& solution, LpScratch& scratch);

/// Returns whether the status of a solution follows from the data of the program.
///
/// An optimal solution needs residuals below `tolerance`. An infeasible or unbounded program needs
/// a certificate that proves it. Any other status gives false.
///
/// A certificate is judged relative to its own terms, so its length does not matter:
///
/// * Infeasible: y'b must exceed the supremum by the sum of two amounts. One is 1e-10 of the sum of
///   all magnitudes, far above rounding. The other is the rounding of (A'y)_j times the larger of
///   its bounds, summed over the columns. Where a bound is infinite, (A'y)_j counts as zero below
///   1e-10 of the magnitudes of its terms. Any l > u is a proof without a certificate.
/// * Unbounded: A r = 0 and the bounds hold to 1e-9 of their terms, c'r exceeds 1e-9 of its terms,
///   and x is feasible to `tolerance`.
///
/// @param program    the program
/// @param solution   its solution
/// @param tolerance  of the residuals
bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance = 1e-7);
/// Does the same in storage that the caller provides.
bool verified(const LinearProgram& program, const LpSolution& solution, double tolerance,
              LpScratch& scratch);

/// Sets those entries of a certificate to zero that are rounding compared with its largest entry.
///
/// In a row or column where no other entry counts, they would spoil the proof.
void drop_rounding(Eigen::VectorXd& certificate);

}  // namespace maxwrench
