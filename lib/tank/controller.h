#pragma once

#include "lib/robot/free_motion.h"
#include "lib/tank/effort_tracking.h"
#include "maxwrench/posture.h"
#include "maxwrench/tank.h"

namespace maxwrench {

/// Holds a posture while the end effector exerts a wrench (see `run_tank`), from a measured motion.
class PostureController {
 public:
  /// Keeps references to the problem and the options.
  PostureController(const Problem& problem, const Posture& posture, Wrench wrench,
                    const TankOptions& options);
  PostureController(const Problem&&, const Posture&, Wrench, const TankOptions&) = delete;

  /// Fills `request` for a motion and a wrench h: the control effort tau_c, the preferred efforts
  /// u_star, and the bounds from the effort limits and from the rate limits during `period` after
  /// u_before.
  void request(const Motion& motion, const Vector6d& h, const Eigen::VectorXd& u_star,
               const Eigen::VectorXd& u_before, double period, EffortRequest& request);

  /// The same, but with a given acceleration of all velocities (n) instead of one from the
  /// posture's errors. The wrenches that the cell takes are turned by `turn`.
  void request(const Motion& motion, const Eigen::VectorXd& acceleration, const Vector6d& h,
               const Eigen::Matrix3d& turn, const Eigen::VectorXd& u_star,
               const Eigen::VectorXd& u_before, double period, EffortRequest& request);

  EffortTracker& tracker() { return tracker_; }
  /// max |theta_r - its reference|.
  double theta_r_error(const Motion& motion) const;
  /// The largest deviation of a joint or of the base from its reference [rad, m].
  double moved(const Motion& motion) const;

 private:
  Vector6d offset(const Pose<double>& base) const;
  void accelerate_posture(const Motion& motion);
  void accelerate_all(const Motion& motion);
  void set_motion(const Motion& motion);
  void fill(const Motion& motion, const Vector6d& h, const Eigen::VectorXd& u_star,
            const Eigen::VectorXd& u_before, double period, EffortRequest& request);
  void leave_free(EffortRequest& request) const;

  const Problem& problem_;
  const EndEffector& tool_;
  const TankOptions& options_;
  Dynamics dynamics_;
  EffortTracker tracker_;
  Posture reference_, now_;
  Matrix6Xd across_;  ///< 6×k: the wrenches that the cell takes without a request
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();  ///< the rotation of across_
  Eigen::MatrixXd A_r_;
  Eigen::VectorXd a_, error_;
};

}  // namespace maxwrench
