#pragma once

#include <array>
#include <vector>

#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

/// Rigid-body quantities of a robot. The scalar T is double, or a dual number for exact
/// derivatives. The constants of the tree are prepared once; evaluation allocates nothing.
///
/// Velocities are n numbers: [free base axes in base axes; joint rates].
template <class T>
class Kinematics {
 public:
  /// The robot must outlive this object.
  explicit Kinematics(const Robot& robot);
  explicit Kinematics(const Robot&&) = delete;

  /// Computes the poses of all links relative to the base at the joint positions q.
  void set_joints(const VectorX<T>& q) { set_joints(q, all_joints_); }

  /// The same if only the joints `changed` differ, listed from the base outward. The list must
  /// include all joints that they carry.
  void set_joints(const VectorX<T>& q, const std::vector<int>& changed);

  /// Sets the wet masses to those of the robot with these changes, in place of earlier ones. The
  /// next `gravity_and_buoyancy` takes them into account.
  void set_loads(const std::vector<LinkLoad>& loads);

  /// J, 6×n [-, m]: maps velocities to the twist [linear; angular] of the end effector, in world
  /// axes at its origin.
  void jacobian(const EndEffector& end_effector, const Matrix3<T>& R_base, Matrix6X<T>& J) const;

  /// tau_d at rest, n numbers [N, N m], the g(theta) of eq:dynamics: the gradient along the
  /// velocities of the potential energy sum_i (m_i z_com,i - rho V_i z_cob,i) g, minus that of the
  /// trim's lift.
  void gravity_and_buoyancy(const Matrix3<T>& R_base, VectorX<T>& tau_d);

  const std::vector<Pose<T>>& links() const { return links_; }
  Pose<T> end_effector(const EndEffector& e) const { return links_[e.link] * e.placement; }

  Vector3<T> end_effector_position(const EndEffector& e) const {
    return links_[e.link].R * e.placement.p + links_[e.link].p;
  }

  /// Unit vector along the axis of joint i, in base axes.
  Vector3<T> joint_axis(std::size_t i) const { return links_[i + 1].R * constants_[i].axis; }
  /// Wet mass [kg] of a link and all that it carries, and its first moment [kg m] about the base
  /// origin in base axes, in the state of the last `gravity_and_buoyancy`.
  double carried_mass(std::size_t link) const { return carried_mass_[link]; }
  const Vector3<T>& carried_moment(std::size_t link) const { return carried_moment_[link]; }

 private:
  /// Rotation about the joint axis by Rodrigues' formula, including the placement: K0 + sin(q) K1 +
  /// (1 - cos(q)) K2.
  struct JointConstants {
    std::array<Matrix3<double>, 3> K;
    Vector3<double> axis;  ///< in the axes of the link that the joint moves
  };

  const Robot* robot_;
  std::vector<JointConstants> constants_;
  std::vector<int> all_joints_;
  std::vector<Pose<T>> links_;
  // Wet mass (mass minus displaced water, on the base also minus the trim) and first moment, of the
  // link and of all that it carries.
  std::vector<Vector3<double>> link_moment_;
  std::vector<double> link_mass_, carried_mass_;
  // The robot's own.
  std::vector<Vector3<double>> own_moment_;
  std::vector<double> own_mass_;
  std::vector<Vector3<T>> carried_moment_;
};

}  // namespace maxwrench
