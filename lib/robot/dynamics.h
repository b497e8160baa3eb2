#pragma once

#include <vector>

#include "lib/robot/kinematics.h"
#include "lib/robot/spatial.h"
#include "maxwrench/robot.h"

namespace maxwrench {

/// The equations of motion of a tree on its base (eq:dynamics, eq:reducedDynamics), templates on
/// the scalar as Kinematics; evaluation allocates nothing.
///
///   tau_d = M(theta) v_d + C(theta, v) v + D(theta, v) v + g(theta),   tau_d + J'h_e = B u
///
/// v, n numbers: the base's twist at the base origin on its free axes, in base axes, then joint
/// rates [m/s, rad/s]. v_d: the componentwise derivative of v; the terms of the turning axes are
/// part of C. tau_d, n numbers [N, N m].
///
/// The water is at rest, so a body and the water that it moves have one momentum, linear in the
/// body's twist (Kirchhoff): added mass is an inertia that differs between axes, with Coriolis
/// terms of its own. Added mass and drag act as given, whatever the water's density; the loader
/// refuses them in air. Joints have no friction, motors no inertia.
template <class T>
class Dynamics {
 public:
  /// The robot outlives this.
  explicit Dynamics(const Robot& robot);
  explicit Dynamics(const Robot&&) = delete;

  /// theta: orientation of the base in the world, joint positions. Nothing depends on where the
  /// base is.
  void set_configuration(const Matrix3<T>& R_base, const VectorX<T>& q);

  /// M n×n [kg, kg m, kg m^2], symmetric, with added mass.
  void mass_matrix(MatrixX<T>& M);
  /// C(theta, v) v, with the terms of added mass.
  void coriolis(const VectorX<T>& velocity, VectorX<T>& C_v);
  /// D(theta, v) v: the drag that the actuators overcome. Differentiable once where v is zero.
  void damping(const VectorX<T>& velocity, VectorX<T>& D_v);
  /// g(theta): weight, buoyancy and trim.
  void gravity(VectorX<T>& g) { kinematics_.gravity_and_buoyancy(R_base_, g); }

  /// tau_d of a motion, by the recursive Newton-Euler algorithm.
  void inverse(const VectorX<T>& velocity, const VectorX<T>& acceleration, VectorX<T>& tau_d);

  /// The motion under actuator forces tau = B u, free of contact: v_d of tau_d(theta, v, v_d) =
  /// tau.
  void forward(const VectorX<T>& velocity, const VectorX<T>& tau, VectorX<T>& acceleration);
  /// The same while an end effector exerts h_e = [force; torque] in world axes at its origin on the
  /// environment: v_d of tau_d(theta, v, v_d) = tau - J'h_e.
  void forward(const VectorX<T>& velocity, const VectorX<T>& tau, const EndEffector& end_effector,
               const Vector6<T>& h_e, VectorX<T>& acceleration);

  /// At the configuration that was set.
  const Kinematics<T>& kinematics() const { return kinematics_; }

 private:
  using Screw = maxwrench::Screw<T>;

  static Screw base_unit(int axis);
  Screw base_twist(const VectorX<T>& velocity) const;
  void set_twists(const VectorX<T>& velocity);
  void set_twist_rates(const VectorX<T>& velocity, const VectorX<T>& acceleration);
  void clear_forces();
  void add_force(int link, const Pose<T>& frame, const Screw& wrench);
  void add_inertial_forces();
  void add_drag();
  void project_forces(VectorX<T>& tau);

  const Robot* robot_;
  Kinematics<T> kinematics_;
  std::vector<Inertia<double>> inertia_;  ///< of each link with its water, at its origin and axes
  Matrix3<T> R_base_ = Matrix3<T>::Identity();
  std::vector<Screw> axes_;  ///< of each joint: the twist of its link per joint rate
  std::vector<Screw> twists_, twist_rates_;
  std::vector<Screw> forces_;  ///< on each link, once projected also on all that it carries
  std::vector<Inertia<T>> carried_;
  VectorX<T> zero_, load_, tau_;
  MatrixX<T> M_;
  Matrix6X<T> J_;
};

}  // namespace maxwrench
