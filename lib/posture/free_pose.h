#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// `pose_at` in any scalar. Further coordinates may follow theta_r.
template <class T>
Pose<T> free_pose(const Problem& problem, const VectorX<T>& theta_r);

/// Throws std::invalid_argument unless theta_r has the problem's size and is finite.
void require_theta_r(const Problem& problem, const Eigen::VectorXd& theta_r);

/// The twist [linear; angular] of the end effector, in world axes at its origin, along free
/// coordinate i of its pose at theta_r: the derivative of `pose_at`.
Vector6d free_twist(const Problem& problem, const Eigen::VectorXd& theta_r, int i);

/// Turns all wrenches of a problem, as `Problem::c`, and the axes of those that it gives.
void turn_wrenches(const Eigen::Matrix3d& turn, Problem& problem);

}  // namespace maxwrench
