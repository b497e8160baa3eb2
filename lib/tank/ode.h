#pragma once

#include <vector>

#include "lib/robot/free_motion.h"
#include "maxwrench/path.h"
#include "maxwrench/tank.h"

namespace maxwrench {

/// The robot in the tank. The state is its motion (see lib/robot/free_motion.h), then the thrust of
/// each thruster [N], which follows its command with a first-order lag and within its rate limit.
/// Joint torques are those commanded. The requested efforts are linear between two instants. The
/// command of a thruster leads by its lag times the slope, within its limits; away from the limits
/// its thrust is therefore the requested one.
class TankOde final : public Ode {
 public:
  /// Keeps references to the problem and the options.
  TankOde(const Problem& problem, const Posture& posture, const TankOptions& options);
  TankOde(const Problem&&, const Posture&, const TankOptions&) = delete;

  /// Makes the cell that holds the end effector follow `path`, which must outlive this object,
  /// instead of staying at rest.
  void hold_along(const Path& path) { path_ = &path; }
  /// Starts from a motion, with the thrusts already at their commands.
  void start(const Motion& motion, const Eigen::VectorXd& u);
  void restart(const Eigen::VectorXd& y) { start_ = y; }
  /// Commands efforts and, with a load, the wrench on its support, from t_0 to t_1.
  void command(double t_0, const Eigen::VectorXd& u_0, double t_1, const Eigen::VectorXd& u_1,
               const Vector6d& h_0, const Vector6d& h_1);
  /// Lets an actuator fail: from now on it exerts nothing, whatever is commanded.
  void kill(int actuator);
  bool is_dead(Eigen::Index actuator) const {
    return dead_[static_cast<std::size_t>(actuator)] != 0;
  }
  void set_noise(const Eigen::VectorXd& noise) { noise_ = noise; }

  const Eigen::VectorXd& initial() const override { return start_; }
  bool derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) override;
  /// The rows of v are M v' + C v + D v + g + J'h_e - B u.
  bool residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                Eigen::VectorXd& F) override;

  /// The stiff terms of d F/d y + alpha d F/d y': masses, the cell's stiffness and damping, and the
  /// lag. Coriolis forces, drag and weight are left out.
  bool residual_jacobian(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                         double alpha, Eigen::MatrixXd& dF) override;

  void read(const Eigen::VectorXd& y, Motion& motion) const { read_motion(y, motion); }
  /// The efforts in the state of `initial`, without noise and losses.
  Eigen::VectorXd efforts(double t) const;
  /// h_e: K [p_e - p_0; rotation vector of R_e R_0'] + D (J v - x_0_dot), with p_0, R_0 and x_0_dot
  /// those of the cell. With a load, the wrench on its support.
  Vector6d wrench(double t, const Motion& motion);
  /// The displacement [m, rad] of the end effector from the cell's pose, in world axes.
  Vector6d displacement(double t, const Motion& motion);
  /// The twist [m/s, rad/s] of the end effector, in world axes.
  Vector6d twist(const Motion& motion);

  long evaluations() const { return evaluations_; }
  double seconds() const { return seconds_; }

 private:
  double share(double t) const { return (t - t_0_) / (t_1_ - t_0_); }
  PathPoint held(double t) const { return path_ ? path_->at(t) : anchor_; }
  Vector6d displacement(const Pose<double>& from, const Motion& motion);
  void prepare(double t, const Eigen::VectorXd& y, Eigen::VectorXd& rates);

  const Problem& problem_;
  const EndEffector& tool_;
  const TankOptions& options_;
  Dynamics dynamics_;
  PathPoint anchor_;
  const Path* path_ = nullptr;
  Vector6d stiffness_, damping_;
  Eigen::VectorXd rate_max_, start_, u_0_, u_1_, noise_, u_, tau_, v_d_, tau_d_, rates_;
  Vector6d exerted_0_ = Vector6d::Zero(), exerted_1_ = Vector6d::Zero(), h_e_;
  double t_0_ = 0, t_1_ = 1;
  Motion motion_;
  Matrix6Xd J_;
  std::vector<char> dead_;  ///< for each actuator whether it failed
  Eigen::MatrixXd M_, shifts_, pull_;
  long evaluations_ = 0;
  double seconds_ = 0;
};

}  // namespace maxwrench
