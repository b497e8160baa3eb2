#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

// Which wrenches can do work. Where an end effector cannot move, the structure (a guide, the floor,
// the bearings of a planar arm) takes any force and no actuator notices: such a wrench has no bound
// and is none that the robot exerts.

/// The twists with which the end effector can leave the task's pose: an orthonormal basis 6×r in
/// world axes at the end effector, unit vectors where that is possible. The range of J at
/// theta_r_default; all regular postures share it, as it touches the r-dimensional set of poses
/// that are reached. Where the wrenches turn with the end effector, turned back to `Problem::pose`.
Matrix6Xd motions_at_pose(const Problem& problem);

/// The orthogonal projector, in contact axes, onto forces that the second end effector's velocity
/// has a part along in some posture, and torques that its angular velocity has. The identity if
/// that depends on the regrasp coordinates.
Eigen::Matrix<double, 6, 6> movable_at_contact(const Robot& robot, const Contact& contact);

/// An orthonormal basis of the range of A, of unit vectors where that is possible.
Eigen::MatrixXd tidy_range(const Eigen::MatrixXd& A);

}  // namespace maxwrench
