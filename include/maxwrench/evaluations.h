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
  /// Gradients by theta_r (N×r); NaN where there is no value. Empty unless they were requested.
  Rows gradient;
  Rows q,    ///< all joints [rad or m] (N×J)
      base,  ///< base in the world: x, y, z, roll, pitch, yaw [m; rad] (N×6)
      u,     ///< efforts [N or N m] (N×m); NaN where there is no value
      h;     ///< wrenches in the world [N; N m] (N×6); NaN likewise
};

/// Evaluates a static task at each row of `theta_r`.
///
/// Row i has the numbers that `evaluate` gives at theta_r.row(i), bit for bit: the same lower
/// level, verified in the same way. The rows are evaluated in parallel; their values do not depend
/// on `Options::threads`. `Options::progress` gets the number of finished rows, which grows from
/// call to call. `Options::interrupted` is asked from time to time; once it returns true, the
/// remaining rows have the status kBudgetExhausted.
///
/// @param task       a static task
/// @param theta_r    the redundant coordinates, one posture in each row (N×r)
/// @param options    measure, wrench, solver, threads and others
/// @param gradients  whether to compute the gradients
/// @return the values
/// @throws std::invalid_argument as `evaluate`, and for a task in time.
Evaluations evaluate_each(const Problem& task, const Evaluations::Rows& theta_r,
                          const Options& options = {}, bool gradients = false);

/// Evaluates a static task in each posture that is given by all joints.
///
/// Row i has the numbers that `evaluate_posture` gives at q.row(i), bit for bit. There are no
/// gradients. Threads, progress and interruptions are those of `evaluate_each`.
///
/// @param task     a static task with one contact
/// @param q        positions of all joints, one posture in each row (N×J) [rad or m]
/// @param options  measure, wrench, solver, threads and others
/// @return the values; `Evaluations::base` is the mount
/// @throws std::invalid_argument as `evaluate_posture`.
Evaluations evaluate_each_posture(const Problem& task, const Evaluations::Rows& q,
                                  const Options& options = {});

}  // namespace maxwrench
