#pragma once

#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// A static task without a second contact, held at the pose where all joints q put the end effector
/// with the base at its mount. c turns with the end effector if the task gives it in those axes.
Problem held_at_joints(const Problem& problem, const Eigen::VectorXd& q);

/// The posture with these joints and the base at its mount, of a task of `held_at_joints`. It is
/// invalid if a joint exceeds its limits or, with `check_collision`, if bodies collide.
Posture given_posture(const Problem& held, const Eigen::VectorXd& q, bool check_collision);

}  // namespace maxwrench
