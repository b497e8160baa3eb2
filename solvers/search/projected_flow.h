#pragma once

#include <memory>
#include <optional>

#include "lib/trajectory/window_evaluator.h"
#include "solvers/search/path_plan.h"

namespace maxwrench {

/// The flow along the projected gradient of a capability on a path. The capability f(t, theta_r) is
/// that of the instant t while theta_r rests and the end effector moves as the path does, so it is
/// a function of the posture. In the redundant coordinates,
///
///     theta_r_dot = alpha M^-1 d f/d theta_r,   M = A_r'A_r,
///
/// on the coordinates that do not leave a limit. alpha is as large as the speed limits of all
/// joints permit, then halved until the step of an instant raises f at that instant.
class ProjectedFlow {
 public:
  /// All arguments must outlive this object. The task is a path.
  ProjectedFlow(const InstantSource& source, const Problem& problem, InstantCount& count);

  /// Whether evaluations ran out; then the last `climb` or `flow` ended early.
  bool stopped() const { return stopped_; }

  /// f at an instant; where no efforts balance the motion, as `WindowEvaluator::evaluate`;
  /// -infinity where there is no value, or the posture collides.
  double value(int instant, const Eigen::VectorXd& theta_r);
  /// Climbs at t = 0, where no time passes, until nothing rises.
  Eigen::VectorXd climb(Eigen::VectorXd theta_r);
  /// The postures at the knots (K×r) of the flow from a posture at t = 0, which are control points
  /// of a motion that does not pass through them. Where an instant has no value, theta_r rests.
  Eigen::MatrixXd flow(Eigen::VectorXd theta_r);

 private:
  std::optional<double> step(int instant, double f, const Eigen::VectorXd& reach, bool in_time,
                             Eigen::VectorXd& theta_r);
  Eigen::VectorXd direction(Eigen::MatrixXd M, Eigen::VectorXd g,
                            const Eigen::VectorXd& theta_r) const;
  double share_of_speeds(const Eigen::VectorXd& added, const Eigen::VectorXd& v) const;

  const Problem& problem_;
  InstantCount& count_;
  std::unique_ptr<WindowEvaluator> at_;  ///< one instant, which rests
  int intervals_;                        ///< between instants
  double step_time_;                     ///< between instants [s]
  bool stopped_ = false;
  Eigen::MatrixXd gradient_;
};

}  // namespace maxwrench
