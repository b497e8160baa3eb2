#pragma once

#include <array>

#include "lib/posture/ik/contact_arm.h"
#include "maxwrench/posture.h"

namespace maxwrench {

/// The second arm of a problem with a second contact: the IK solutions that reach the contact, and
/// the derivative of f(theta_r) through them.
class SecondArm {
 public:
  /// Keeps a reference to the problem.
  explicit SecondArm(const Problem& problem);
  explicit SecondArm(const Problem&& problem) = delete;

  /// Sets the contact to the regrasp coordinates at the end of theta_r.
  void touch(const Eigen::VectorXd& theta_r);
  /// Finds all IK solutions that reach the contact from the base pose, and returns their number.
  int reach(const Pose<double>& base);
  /// Whether IK solution i is within the limits of its joints.
  bool within_limits(int i) const;
  /// Writes IK solution i into q.
  void place(int i, Eigen::VectorXd& q) const;

  const Pose<double>& contact() const { return pose_; }
  const Matrix6Xd& C_2() const { return C_2_; }

  /// Seeds of all velocities about the first end effector, at p_e in the world: J_seed for the
  /// velocities that move it. The seed [a; b] of a column of J_2 becomes [a; b + r × a], with r =
  /// p_2 - p_e.
  const Matrix6Xd& shifted_seeds(const Eigen::Vector3d& p_e, const Matrix6Xd& J_seed,
                                 const Matrix6Xd& J2_seed);

  /// Turns the derivatives by all joints at a fixed contact point into derivatives along the
  /// contact. The contribution of the second arm's dependent joints moves to the joints of the
  /// first chain (in `q_gradient`) and to the regrasp coordinates (the end of `gradient`).
  void follow(const Eigen::Vector3d& p_e, const Matrix6Xd& J, const Matrix6Xd& J_2,
              const Matrix6Xd& J2_seed, const Matrix6Xd& C2_seed, Eigen::VectorXd& q_gradient,
              Eigen::VectorXd& gradient);

  /// The contribution of the second arm to the derivative by the twist of the first end effector,
  /// at constant joints of its chain. Call `follow` first.
  Vector6d by_twist(const Eigen::Vector3d& p_e) const;

 private:
  const Problem& problem_;
  const Contact& contact_;
  ContactArm arm_;
  std::vector<char> first_, second_;  ///< whether a velocity moves each end effector
  std::array<double, 2> s_{};
  Pose<double> pose_;
  Matrix6Xd C_2_, seeds_;
  Vector6d mu_ = Vector6d::Zero();  ///< J_f' mu = derivatives by the dependent joints
};

}  // namespace maxwrench
