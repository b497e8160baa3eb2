#pragma once

#include <vector>

#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

struct Posture;

/// Adds `factor` times the generalised forces tau (n) [N, N m] that the actuators must exert, at
/// rest, because of changes of wet masses: the terms of `Kinematics::gravity_and_buoyancy` of these
/// loads alone. Allocates nothing.
void add_static_loads(const Robot& robot, const Posture& posture,
                      const std::vector<LinkLoad>& loads, double factor,
                      Eigen::Ref<Eigen::VectorXd> tau);

/// The unit wrench of a payload at a posture, in world axes at the end effector's origin: what the
/// robot exerts on 1 kg. R: the end effector's orientation in the world. With s the first moment of
/// the wet mass,
///
///     c = [g m_wet e_z; (R s) x (g e_z)].
Vector6d payload_wrench(const Robot& robot, const CarriedLoad& payload, const Eigen::Matrix3d& R);

/// The derivative of lambda'J'c by a turn of the end effector (world axes) at constant J, for the
/// wrench of a payload: w_e = angular part of J lambda.
Eigen::Vector3d payload_slope(const Robot& robot, const CarriedLoad& payload,
                              const Eigen::Matrix3d& R, const Eigen::Vector3d& w_e);

}  // namespace maxwrench
