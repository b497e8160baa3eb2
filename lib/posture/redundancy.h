#pragma once

#include "maxwrench/posture.h"

namespace maxwrench {

// A_r of eq:redundantJacobian, `theta_dot = J_e x_dot + A_r theta_r_dot`. The dependent velocities
// (free base axes, and joints of the chain to the end effector that theta_r does not hold) follow
// from the twist that theta_r leaves to them. With J_d their columns of J (6×d, full column rank,
// square and invertible for a base on all six axes) and J_r the columns of theta_r,
//
//     A_r = [-J_d^+ J_r; I]   in the rows of the dependent and of theta_r.
//
// A free coordinate of the pose with the twist t moves J_d^+ t, the joints of theta_r resting. With
// a second contact its arm follows, and regrasp coordinates move that arm alone. Other joints
// beside the chain rest. Nothing is allocated once the result has its size.

/// A_r n×r [-, 1/m, m]: theta_r_dot -> velocities that leave the end effector where it is, J A_r =
/// 0, but for the columns of free pose coordinates, where J A_r = t.
void null_motion(const Problem& problem, const Posture& posture, Eigen::MatrixXd& A_r);

}  // namespace maxwrench
