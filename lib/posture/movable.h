#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

// Which wrenches can do work. In directions in which an end effector cannot move, the structure (a
// guide, the floor, the bearings of a planar arm) takes any force without effect on the actuators.
// The robot does not exert such a wrench, and it has no bound.

/// The twists with which the end effector can leave the task's pose: an orthonormal basis 6×r, in
/// world axes at the end effector, of unit vectors where possible. It spans the range of J at
/// theta_r_default. All regular postures share this range, because it is tangent to the
/// r-dimensional set of reachable poses. If the wrenches turn with the end effector, the basis is
/// turned back to `Problem::pose`.
Matrix6Xd motions_at_pose(const Problem& problem);

/// The orthogonal projector, in contact axes, onto the forces along directions in which the second
/// end effector can move in some posture, and the torques about directions in which it can turn.
/// The identity if these depend on the regrasp coordinates.
Eigen::Matrix<double, 6, 6> movable_at_contact(const Robot& robot, const Contact& contact);

/// An orthonormal basis of the range of A, of unit vectors where possible.
Eigen::MatrixXd tidy_range(const Eigen::MatrixXd& A);

}  // namespace maxwrench
