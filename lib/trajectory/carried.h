#pragma once

#include "maxwrench/carried.h"
#include "maxwrench/path.h"
#include "maxwrench/robot.h"

namespace maxwrench {

/// The end effector's orientation, twist and acceleration as in `PathPoint`.
template <class T>
struct ToolMotion {
  Matrix3<T> R;
  Vector6<T> twist, acceleration;
};

/// The wrench [force; torque] that the end effector exerts on 1 kg of a body that it carries, in
/// world axes at its origin. With v, w, a, alpha its motion, c = R r, V = R'(v + w x c - v_c) and
/// W = R'w the body's own rates, a_c the acceleration of its centre of mass, I = R I_kg R' and b =
/// rho V_kg g e_z, and v_c the robot's current,
///
///     f = a_c + g e_z - b + f_A,
///     n = c x (a_c + g e_z + f_A) + I alpha + w x (I w) - (R r_b) x b + n_A,
///     f_A = R (A V_dot + W x A V),   n_A = R (A_r W_dot + W x A_r W + V x A V).
template <class T>
Vector6<T> carried_wrench(const Robot& robot, const CarriedBody& body, const ToolMotion<T>& tool);

/// The wrench of a task with one factor (`MotionTask::has_factor`), for a factor of 1, in world
/// axes.
Vector6d factored_wrench(const Robot& robot, const MotionTask& task, double t, const PathPoint& x);

}  // namespace maxwrench
