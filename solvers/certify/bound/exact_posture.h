#pragma once

#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/multi_affine.h"

namespace maxwrench {

/// The joint that each coordinate of a posture, x = [theta_r; dependent joints; second arm's
/// joints; ...], moves; -1 for none.
std::vector<int> moved_joints(const Problem& problem);

/// Wrenches of the task in the directions that they have at a pose of the end effector.
Matrix6X<Extended> exact_turned(const Problem& problem, const Pose<Extended>& pose,
                                const Matrix6Xd& wrenches);

/// J and tau_d at theta_r in the precision of `Extended`, of a static task with one contact whose
/// base pose follows in closed form. In base axes both are multi-affine: a quantity that is fixed
/// at the end effector is turned once about each free coordinate of the end effector's pose, then
/// once about each joint, from link to link towards the base.
class ExactPosture {
 public:
  /// Keeps a reference to the problem.
  explicit ExactPosture(const Problem& problem);
  explicit ExactPosture(const Problem&&) = delete;

  /// Also accepts [theta_r; dependent joints; second arm's joints; ...]; then only `links` is
  /// valid.
  void set(const ExtendedVector& theta_r);
  const Matrix6X<Extended>& J() const { return J_; }      ///< 6×n
  const ExtendedVector& tau_d() const { return tau_d_; }  ///< n
  /// Wrenches of the task, 6×k, in the directions that they have at this pose.
  Matrix6X<Extended> turned(const Matrix6Xd& wrenches) const {
    return exact_turned(problem_, pose_, wrenches);
  }
  /// Poses relative to the base.
  const std::vector<Pose<Extended>>& links() const { return kinematics_.links(); }

 private:
  const Problem& problem_;
  std::vector<int> joints_;
  Kinematics<Extended> kinematics_;
  ExtendedVector q_, tau_d_;
  Pose<Extended> pose_;  ///< of the end effector
  Matrix6X<Extended> J_;
};

/// All coordinates of theta_r.
Coordinates all_coordinates(const Problem& problem);

}  // namespace maxwrench
