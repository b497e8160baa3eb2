#pragma once

#include <memory>
#include <vector>

#include "lib/trajectory/window_evaluator.h"
#include "solvers/search/path_plan.h"

namespace maxwrench {

/// The flow along the projected gradient of a capability on a path. The capability f(t, theta_r) is
/// that of the instant t while theta_r rests and the end effector moves as the path does, so it is
/// a function of the posture. In the redundant coordinates,
///
///     theta_r_dot = alpha M^-1 d f/d theta_r,   M = A_r'A_r,
///
/// on the coordinates that do not leave a limit. alpha is the largest number, after halvings, that
/// no joint's speed limit forbids and with which the step of an instant raises f at that instant.
class ProjectedFlow {
 public:
  /// All arguments must outlive this object. The task is a path.
  ProjectedFlow(const InstantSource& source, const Problem& problem, InstantCount& count);

  int instants() const { return static_cast<int>(instants_.size()); }
  /// Whether evaluations ran out; then the last `climb` or `flow` ended early.
  bool stopped() const { return stopped_; }

  /// f at an instant; -infinity where there is no value, or the posture collides.
  double value(int instant, const Eigen::VectorXd& theta_r);
  /// Climbs at t = 0, where no time passes, until nothing rises.
  Eigen::VectorXd climb(Eigen::VectorXd theta_r);
  /// The postures at the knots (K×r) of the flow from a posture at t = 0. Where the instant has no
  /// value, theta_r rests.
  Eigen::MatrixXd flow(Eigen::VectorXd theta_r);

 private:
  bool step(int instant, const Eigen::VectorXd& reach, bool in_time, Eigen::VectorXd& theta_r);
  Eigen::VectorXd direction(Eigen::MatrixXd M, Eigen::VectorXd g,
                            const Eigen::VectorXd& theta_r) const;
  double share_of_speeds(const Eigen::VectorXd& added, const Eigen::VectorXd& v) const;

  const Problem& problem_;
  InstantCount& count_;
  std::vector<std::unique_ptr<WindowEvaluator>> instants_;
  int per_interval_;
  double step_time_;  ///< between instants [s]
  bool stopped_ = false;
  Eigen::MatrixXd gradient_;
};

}  // namespace maxwrench
