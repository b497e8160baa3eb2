#pragma once

#include "lib/robot/dynamics.h"
#include "lib/robot/dynamics_slopes.h"
#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

/// Whether a case of a load, or of a list, has a current.
bool has_current(const LoadGroup& cases);
bool has_current(const ScenarioList& list);

/// What a steady, uniform current adds to tau_d of a robot at rest.
///
/// In the water's own frame, which moves steadily, the robot moves at V = -R'v_c (base axes)
/// without turning. So the load is that of this motion in still water: drag, and the moment
/// V x (A V) of the added mass A (Munk). It is the inverse dynamics of a robot without weight whose
/// base has all six velocities. Evaluation allocates nothing.
class CurrentLoad {
 public:
  explicit CurrentLoad(const Robot& robot);

  /// Sets the configuration: orientation of the base in the world, and joint positions.
  void set(const Eigen::Matrix3d& R_base, const Eigen::VectorXd& q);
  /// The load (n) [N, N m] at a velocity of the water in the world [m/s].
  void evaluate(const Eigen::Vector3d& current, Eigen::Ref<Eigen::VectorXd> tau);
  /// The derivatives of lambda'tau (lambda: n) by the joint positions at resting base, added to
  /// `by_q`, and by a turn of the base in world axes, which is returned.
  Eigen::Vector3d add_slopes(const Eigen::Vector3d& current, const Eigen::VectorXd& lambda,
                             Eigen::VectorXd& by_q);

 private:
  void set_velocity(const Eigen::Vector3d& current);

  std::vector<int> base_axes_;
  Robot free_;  ///< the robot without weight, with all base axes
  Dynamics dynamics_;
  DynamicsSlopes slopes_;
  Eigen::Matrix3d R_base_ = Eigen::Matrix3d::Identity();
  Eigen::VectorXd q_, velocity_, zero_, tau_, lambda_;
};

}  // namespace maxwrench
