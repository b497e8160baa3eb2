#pragma once

#include <vector>

#include "maxwrench/trajectory.h"
#include "solvers/search/row_program.h"

namespace maxwrench {

/// A trajectory with one factor t at all instants, such as the mass of a transfer, as a smooth
/// program between facets. With x the stacked knots, y = (x, t/s), a_i = (J'W)_i / c_w,i:
///
///     max t   subject to   b_min <= N'(tau_d,i(x) + a_i(x) t) <= b_max,   t_min <= t <= t_max,
///     r_min <= R x <= r_max
///
/// The rows of an instant are divided by half their widths. s is |t| of the start, or what its most
/// loaded row can bear, if that is larger.
class FactorProgram final : public RowProgram {
 public:
  /// Whether the program of a task is of this kind: a common factor, facets, and neither rates of
  /// efforts nor dependent joints.
  static bool supports(const TrajectoryEvaluator& trajectories, bool dependent_joints);

  /// Starts at the stacked knots x with the factor t. At most `points` points are evaluated.
  FactorProgram(TrajectoryEvaluator& trajectories, const Eigen::VectorXd& x_min,
                const Eigen::VectorXd& x_max, const Eigen::VectorXd& x, double t, long points);

  bool ended() const override { return points_ == 0; }
  bool look(const Eigen::VectorXd& y) override;
  const Jacobian& jacobian() override { return jacobian_; }

  Eigen::VectorXd knots(const Eigen::VectorXd& y) const { return y.head(y.size() - 1); }
  /// The points that were evaluated.
  long looked() const { return looked_; }

 private:
  bool set_rows(const Eigen::VectorXd& y);

  TrajectoryEvaluator& trajectories_;
  Eigen::Index p_, facets_ = 0;
  double scale_ = 1;
  long points_, looked_ = 0;
  Eigen::VectorXd unit_, y_;
  std::vector<Eigen::VectorXd> w_;
  bool valid_ = false;
  Jacobian jacobian_;
};

}  // namespace maxwrench
