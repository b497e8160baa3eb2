#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// The twist [linear; angular] of the end effector in world axes, at its origin, along free
/// coordinate i of its pose at theta_r: the derivative of `pose_at`.
Vector6d free_twist(const Problem& problem, const Eigen::VectorXd& theta_r, int i);

}  // namespace maxwrench
