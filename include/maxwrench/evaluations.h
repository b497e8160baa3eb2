#pragma once

#include <vector>

#include "maxwrench/solve.h"

/// @file
/// Evaluates many postures of a static task at once.

namespace maxwrench {

/// The values of N postures of a static task, one row or number for each.
struct Evaluations {
  /// A matrix with one row for each posture.
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<Status> status;  ///< as of `Answer`: kOptimal, or why there is no value (N)
  Eigen::VectorXd beta;        ///< values [unit]; NaN where there is none (N)
  Rows gradient,               ///< gradients by theta_r (N×r); NaN where there is no value
      q,                       ///< all joints [rad or m] (N×J)
      base,                    ///< base in the world: x, y, z, roll, pitch, yaw [m; rad] (N×6)
      u,                       ///< efforts [N or N m] (N×m); NaN where there is no value
      h;                       ///< wrenches in the world [N; N m] (N×6); NaN likewise
};

/// Evaluates a static task at each row of `theta_r`.
///
/// Row i has the numbers that `evaluate` gives at theta_r.row(i): the same lower level, verified in
/// the same way. The solvers simplex, clp and glpk start at the row before: where the efforts of an
/// optimum are not unique, u may be another choice of them. The rows are evaluated in parallel;
/// their values do not depend on `Options::threads`. `Options::interrupted` is asked from time to
/// time; once it returns true, the remaining rows have the status kBudgetExhausted.
///
/// @param task     a static task
/// @param theta_r  the redundant coordinates, one posture in each row (N×r)
/// @param options  measure, wrench, solver, threads and others
/// @return the values
/// @throws std::invalid_argument as `evaluate`, and for a task in time.
Evaluations evaluate_each(const Problem& task, const Evaluations::Rows& theta_r,
                          const Options& options = {});

}  // namespace maxwrench
