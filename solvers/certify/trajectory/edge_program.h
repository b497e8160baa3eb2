#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory_program.h"

namespace maxwrench {

/// Efforts at the edges of a certificate.
struct EdgeEfforts : Verdict {
  double t = -1;      ///< if infeasible: an instant that has no balance [s]
  double value = 0;   ///< the wrench along c: the least at edges, or that at the peak
  Eigen::MatrixXd y;  ///< m×edges
  Eigen::VectorXd w;  ///< the wrench along c at the edges; empty: `value` throughout
};

/// Positions of the dependent joints at parts of each interval between knots (joints×places), as
/// the certificate has them; empty without such joints. NaN where they have no solution.
Eigen::MatrixXd dependent_places(const Problem& problem, const Eigen::MatrixXd& knots);

/// The largest wrench with efforts at edges, such that the efforts of an `EffortLaw` with these
/// control points stay within their limits.
///
/// With p = B^+ (tau_d + J'c w), these efforts differ from the B-spline by at most H^2/8 |p_ddot|,
/// and their rate from its rate by H^2/6 |p_dddot|; at the first and last part between knots, where
/// the spline is linear, by H/2 |p_ddot|. Limits and rates of the program are tighter by this and
/// by a slack for the enclosures. The proof then checks the efforts themselves.
class EdgeProgram {
 public:
  /// Keeps a reference to the problem.
  ///
  /// @param knots  k×r
  /// @param parts  of each interval between knots
  /// @param t_h    the knot of an impulse's peak
  EdgeProgram(const Problem& problem, const Eigen::MatrixXd& knots, int parts, int t_h);
  EdgeProgram(const Problem&&, const Eigen::MatrixXd&, int, int) = delete;

  /// The largest wrench within limits that are not tightened.
  const EdgeEfforts& most();

  /// @param slack  of limits and rates, as a share of the limit's range
  EdgeEfforts solve(double slack);

 private:
  void tighten(double slack);
  void measure_bends(const Eigen::VectorXd& w);
  EdgeEfforts solve_program();
  EdgeEfforts solve_steadily();
  EdgeEfforts read(const TrajectorySolution& solution) const;
  bool exerts_equally(const TrajectorySolution& solution) const;

  const Problem& problem_;
  int parts_;
  MotionEvaluator motion_;
  std::vector<Instant> instants_;
  TrajectoryProgram loose_, program_;
  Zonotope tight_;
  /// m×(edges - 1), of each part: by how much efforts and rates differ from those of the spline.
  Eigen::MatrixXd off_, rate_off_;
  std::optional<EdgeEfforts> most_;
  std::unique_ptr<TrajectorySolver> solver_;
};

}  // namespace maxwrench
