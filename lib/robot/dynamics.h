#pragma once

#include <vector>

#include "lib/robot/kinematics.h"
#include "lib/robot/spatial.h"
#include "maxwrench/robot.h"

namespace maxwrench {

/// The equations of motion of a tree on its base (eq:dynamics, eq:reducedDynamics). Evaluation
/// allocates nothing.
///
///   tau_d = M(theta) v_d + C(theta, v) v + D(theta, v) v + g(theta),   tau_d + J'h_e = B u
///
/// v, n numbers: the base's twist at the base origin on its free axes, in base axes, then joint
/// rates [m/s, rad/s]. v_d: the componentwise derivative of v; C contains the terms that arise
/// because the axes turn. tau_d: n numbers [N, N m].
///
/// The water is at rest, or it is the robot's steady, uniform current v_c. In axes that move with
/// the water it is at rest and all else is as it was (Galilei). So what counts is the twist
/// relative to the water: that of the base has the linear part v - R'v_c, whose rate is v_d + w x
/// R'v_c.
///
/// A body and the water that it moves have one momentum, linear in the body's twist (Kirchhoff).
/// Added mass is therefore an inertia that differs between axes and has Coriolis terms of its own.
/// Added mass and drag act as given, whatever the water's density; the loader rejects them in air.
/// Joints have no friction, motors no inertia.
class Dynamics {
 public:
  /// The robot must outlive this object.
  explicit Dynamics(const Robot& robot);
  explicit Dynamics(const Robot&&) = delete;

  /// theta: orientation of the base in the world and joint positions. Nothing depends on the
  /// position of the base.
  void set_configuration(const Eigen::Matrix3d& R_base, const Eigen::VectorXd& q);

  /// M n×n [kg, kg m, kg m^2], symmetric, with added mass.
  void mass_matrix(Eigen::MatrixXd& M);
  /// The derivatives of x'M y by the joint positions, for constant velocities x and y (n).
  void mass_slopes(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::VectorXd& slopes);
  /// C(theta, v) v, with the terms of added mass.
  void coriolis(const Eigen::VectorXd& velocity, Eigen::VectorXd& C_v);
  /// D(theta, v) v: the drag that the actuators overcome. It has a first derivative at v = 0 but no
  /// second.
  void damping(const Eigen::VectorXd& velocity, Eigen::VectorXd& D_v);
  /// g(theta): weight, buoyancy and trim.
  void gravity(Eigen::VectorXd& g) { kinematics_.gravity_and_buoyancy(R_base_, g); }

  /// tau_d of a motion, by the recursive Newton-Euler algorithm.
  void inverse(const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration,
               Eigen::VectorXd& tau_d);

  /// The motion under actuator forces tau = B u without contact: v_d such that tau_d(theta, v, v_d)
  /// = tau.
  void forward(const Eigen::VectorXd& velocity, const Eigen::VectorXd& tau,
               Eigen::VectorXd& acceleration);
  /// The motion while an end effector exerts h_e = [force; torque], in world axes at its origin, on
  /// the environment: v_d such that tau_d(theta, v, v_d) = tau - J'h_e.
  void forward(const Eigen::VectorXd& velocity, const Eigen::VectorXd& tau,
               const EndEffector& end_effector, const Vector6d& h_e, Eigen::VectorXd& acceleration);

  /// The kinematics at the configuration that was set.
  const Kinematics<double>& kinematics() const { return kinematics_; }

 private:
  using Screw = maxwrench::Screw<double>;

  static Screw base_unit(int axis);
  static Screw in_base_axes(const Pose<double>& frame, const Screw& wrench);
  Screw base_twist(const Eigen::VectorXd& velocity) const;
  void spread(const Eigen::VectorXd& velocity, std::vector<Screw>& twists) const;
  void set_momenta(const Eigen::VectorXd& velocity, std::vector<Screw>& twists,
                   std::vector<Screw>& momenta) const;
  void gather(std::vector<Screw>& forces) const;
  void set_twists(const Eigen::VectorXd& velocity);
  void set_twist_rates(const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration);
  void clear_forces();
  void add_force(int link, const Pose<double>& frame, const Screw& wrench);
  void add_inertial_forces();
  void add_drag();
  void project_forces(Eigen::VectorXd& tau);

  const Robot* robot_;
  Kinematics<double> kinematics_;
  std::vector<Inertia<double>> inertia_;  ///< of each link with its water, at its origin and axes
  Eigen::Matrix3d R_base_ = Eigen::Matrix3d::Identity();
  bool in_current_;
  Eigen::Vector3d current_ = Eigen::Vector3d::Zero();  ///< in base axes
  std::vector<Screw> axes_;  ///< of each joint: the twist of its link per joint rate
  std::vector<Screw> twists_, twist_rates_;
  std::vector<Screw> forces_;  ///< on each link; after projection also on all links that it carries
  std::vector<Screw> momenta_;
  std::vector<Inertia<double>> carried_;
  Eigen::VectorXd zero_, load_, tau_;
  Eigen::MatrixXd M_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  Matrix6Xd J_;
};

}  // namespace maxwrench
