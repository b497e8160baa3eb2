#pragma once

#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/multi_affine.h"

namespace maxwrench {

/// The joints that coordinates of a posture, x = [theta_r; dependent joints; second arm's joints;
/// ...], move; -1: none.
std::vector<int> moved_joints(const Problem& problem);

/// The pose of the end effector at theta_r, of which x may have more behind it, and wrenches
/// of the task as they are there.
Pose<Extended> exact_pose(const Problem& problem, const ExtendedVector& x);
Matrix6X<Extended> exact_turned(const Problem& problem, const Pose<Extended>& pose,
                                const Matrix6Xd& wrenches);

/// J and tau_d at theta_r with the digits of `Extended`, of a static task with one contact whose
/// base pose follows in closed form. There both are, in base axes, multi-affine: what a pose of the
/// end effector fixes turns from link to link towards the base, once about each joint, as it does
/// about each free coordinate of that pose before.
class ExactPosture {
 public:
  /// Keeps a reference to the problem.
  explicit ExactPosture(const Problem& problem);
  explicit ExactPosture(const Problem&&) = delete;

  /// Or [theta_r; dependent joints; second arm's joints; ...], for `links` alone.
  void set(const ExtendedVector& theta_r);
  const Matrix6X<Extended>& J() const { return J_; }      ///< 6×n
  const ExtendedVector& tau_d() const { return tau_d_; }  ///< n
  /// Wrenches of the task, 6×k, as they are there.
  Matrix6X<Extended> turned(const Matrix6Xd& wrenches) const {
    return exact_turned(problem_, pose_, wrenches);
  }
  /// Relative to the base.
  const std::vector<Pose<Extended>>& links() const { return kinematics_.links(); }

 private:
  const Problem& problem_;
  std::vector<int> joints_;
  Kinematics<Extended> kinematics_;
  ExtendedVector q_, tau_d_;
  Pose<Extended> pose_;  ///< of the end effector
  Matrix6X<Extended> J_;
};

/// All of theta_r.
Coordinates all_coordinates(const Problem& problem);

/// The rows [K tau_d; K J'c], 2m, of a matrix K m×n.
MultiAffine pure_rows(const Problem& problem, const Eigen::MatrixXd& K);

}  // namespace maxwrench
