#pragma once

#include "lib/bound/multi_affine.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// J and tau_d at theta_r with the digits of `Extended`, of a static task with one contact whose
/// base pose follows in closed form. There both are, in base axes, multi-affine: what a pose of the
/// end effector fixes turns from link to link towards the base, once about each joint, as it does
/// about each free coordinate of that pose before.
class ExactPosture {
 public:
  /// Keeps a reference to the problem.
  explicit ExactPosture(const Problem& problem);
  explicit ExactPosture(const Problem&&) = delete;

  void set(const ExtendedVector& theta_r);
  const Matrix6X<Extended>& J() const { return J_; }      ///< 6×n
  const ExtendedVector& tau_d() const { return tau_d_; }  ///< n
  const Vector6<Extended>& c() const { return c_; }       ///< as it is there
  /// Relative to the base.
  const std::vector<Pose<Extended>>& links() const { return kinematics_.links(); }

 private:
  const Problem& problem_;
  Kinematics<Extended> kinematics_;
  ExtendedVector q_, tau_d_;
  Vector6<Extended> c_;
  Matrix6X<Extended> J_;
};

/// The pose of the end effector at theta_r, of which x may have more behind it, and the direction
/// of the wrench there.
Pose<Extended> exact_pose(const Problem& problem, const ExtendedVector& x);
Vector6<Extended> exact_direction(const Problem& problem, const Pose<Extended>& pose);

/// All of theta_r.
Coordinates all_coordinates(const Problem& problem);

/// Throws std::invalid_argument, in one line, if J and tau_d are not multi-affine in theta_r, or
/// not of theta_r alone: a task in time, a second contact, dependent joints, a free pose.
void require_closed_form(const Problem& problem);

/// The rows [K tau_d; K J'c], 2m, of a matrix K m×n.
MultiAffine pure_rows(const Problem& problem, const Eigen::MatrixXd& K);

}  // namespace maxwrench
