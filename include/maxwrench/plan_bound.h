#pragma once

#include <limits>
#include <string>

#include "maxwrench/certify.h"
#include "maxwrench/solve.h"

/// @file
/// Proves what no trajectory of a task in time exceeds.

namespace maxwrench {

/// A bound that no trajectory of a task exceeds, beside the best one that is known. The status is
///
/// * kProven: the gap is at most the requested one;
/// * kBracket: the bound holds, but the gap is larger; the reason says why;
/// * kInfeasible: proved that no trajectory has a value; the bound is -infinity;
/// * that of `answer` if no trajectory with a value is known. The bound holds as well.
struct PlanBound : Verdict {
  Answer answer;  ///< the best trajectory known, or the given one
  /// No trajectory has a larger value [unit of the answer]. -infinity: none has a value, by the
  /// instant t. Infinity: nothing was proven.
  double bound = kInfinity;
  /// The instant whose balance proves the bound [s].
  double t = std::numeric_limits<double>::quiet_NaN();
  /// The largest value found of the relaxation at that instant: the instant alone allows it, so it
  /// limits how low the bound can become. -infinity: none was found.
  double allowed = -kInfinity;
  long boxes = 0;       ///< number of boxes that were bounded, at all instants
  double search_s = 0;  ///< wall time of the search [s]
  double seconds = 0;   ///< wall time of the bound after the search [s]

  /// Returns (bound - value)/|value|; infinite without a value or a bound.
  double gap() const;
};

/// Why a task, or the measure or the wrench of the options, has no bound on its trajectories, in
/// one line; empty if it has one.
std::string why_no_trajectory_bound(const Problem& task, const Options& options = {});

/// Searches for the best trajectory of a task, and proves a bound that none exceeds.
///
/// The bound counts all tables of knots that the task accepts, unless a knot collides. At one
/// instant, the end effector's pose and motion are given. Theta_r, its rate and its acceleration
/// are within the ranges that limits, speed limits and the scheme leave to them at this instant.
/// The bound is the most that any such motion exerts there, by branch and bound; effort rates and
/// other instants are ignored. Along a path it is the least over some instants, because a
/// trajectory's value is the least of all instants. docs/algorithms/trajectory_bounds.md describes
/// it.
///
/// Rounding is counted as in proofs of static tasks, apart from the constants of the task. There is
/// no certificate.
///
/// @param task     a trajectory or an impulse of one contact, whose base's pose has a closed form,
///                 with scheme `spline`; or a trajectory with `forward` or `ends`
/// @param options  as for `solve`; the measure is linf_polytope and the wrench pure
/// @param how      gap and time limit; no certificate
/// @param knots    a trajectory (k×r) in place of a search; empty: none
/// @throws std::invalid_argument, with one line, if there is no such bound (see
///         `why_no_trajectory_bound`) or an option is out of range, or as `solve` and `evaluate`.
PlanBound bound_trajectories(const Problem& task, const Options& options = {},
                             const ProofOptions& how = {}, const Eigen::MatrixXd& knots = {});

}  // namespace maxwrench
