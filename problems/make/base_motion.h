#pragma once

#include "maxwrench/types.h"

namespace maxwrench {

/// [rad] Beyond this pitch the rates of roll and yaw do not give the turning of the base.
inline constexpr double kSteepest = 1.55;

/// A base in motion.
struct BaseMotion {
  Pose<double> pose;             ///< in the world
  Vector6d twist, acceleration;  ///< [linear; angular] in base axes, and its derivative
};

/// The motion of a base from x, y, z, roll, pitch, yaw and their first and second derivatives. With
/// p = (x, y, z), R = Rz(yaw) Ry(pitch) Rx(roll) and the rates a' of the three angles,
///
///     v = R'p',   w = E a',   v_dot = R'p'' - w x v,   w_dot = E a'' + E' a'.
BaseMotion base_motion(const Vector6d& x, const Vector6d& x_dot, const Vector6d& x_ddot);

/// Roll, pitch and yaw of R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Vector3d roll_pitch_yaw(const Eigen::Matrix3d& R);

}  // namespace maxwrench
