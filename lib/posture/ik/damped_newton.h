#pragma once

#include "lib/posture/ik/tool_chain.h"

namespace maxwrench {

/// The damped Newton's method of Levenberg and Marquardt for y in X_e(theta_r, y) = X.
class DampedNewton {
 public:
  /// Both outlive this.
  DampedNewton(const ToolChain& chain, const Pose<double>& pose);
  DampedNewton(const ToolChain&&, const Pose<double>&) = delete;

  /// Starts at y, which receives the closest point that is found. Returns whether it converges.
  bool run(const Eigen::VectorXd& theta_r, Six<double>& y);
  /// [m; rad], the twist in world axes from this point to the pose.
  const Vector6d& error() const { return error_; }
  /// The end effector at this point.
  const ToolState<double>& state() const { return state_; }

 private:
  void linearise(const Eigen::VectorXd& theta_r, const Six<double>& y);

  const ToolChain& chain_;
  const Pose<double>& pose_;
  ToolState<double> state_;
  Vector6d error_;
};

}  // namespace maxwrench
