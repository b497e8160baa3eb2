#pragma once

#include "lib/bound/multi_affine.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// J and tau_d at theta_r with the digits of `Extended`, of a static task with one contact whose
/// base pose follows in closed form. There both are, in base axes, multi-affine: what a pose of the
/// end effector fixes turns from link to link towards the base, once about each joint.
class ExactPosture {
 public:
  /// Keeps a reference to the problem.
  explicit ExactPosture(const Problem& problem);
  explicit ExactPosture(const Problem&&) = delete;

  void set(const ExtendedVector& theta_r);
  const Matrix6X<Extended>& J() const { return J_; }      ///< 6×n
  const ExtendedVector& tau_d() const { return tau_d_; }  ///< n
  /// Relative to the base.
  const std::vector<Pose<Extended>>& links() const { return kinematics_.links(); }

 private:
  const Problem& problem_;
  Kinematics<Extended> kinematics_;
  ExtendedVector q_, tau_d_;
  Matrix6X<Extended> J_;
};

/// All of theta_r.
Coordinates all_coordinates(const Problem& problem);

/// Throws std::invalid_argument, in one line, if J and tau_d are not multi-affine in theta_r, or
/// not of theta_r alone: a task in time, a second contact, dependent joints, a free pose.
void require_closed_form(const Problem& problem);

/// The rows [K tau_d; K J'c], 2m, of a matrix K m×n.
MultiAffine pure_rows(const Problem& problem, const Eigen::MatrixXd& K);

}  // namespace maxwrench
