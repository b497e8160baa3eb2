#pragma once

#include "maxwrench/posture.h"

namespace maxwrench {

// A_r of eq:redundantJacobian, `theta_dot = J_e x_dot + A_r theta_r_dot`. The dependent velocities
// are those of the free base axes and of the joints of the chain to the end effector that theta_r
// does not hold. They compensate the twist due to theta_r. With J_d their columns of J (6×d, full
// column rank, square and invertible for a base on all six axes) and J_r the columns of theta_r,
//
//     A_r = [-J_d^+ J_r; I]   in the rows of the dependent velocities and of theta_r.
//
// A free coordinate of the pose with the twist t moves the dependent velocities by J_d^+ t, while
// the joints of theta_r rest. A second arm moves so that it keeps its contact; regrasp coordinates
// move only that arm. Other joints outside the chain rest. Nothing is allocated once the result has
// its size.

/// A_r n×r [-, 1/m, m]: maps theta_r_dot to velocities that leave the end effector at rest, J A_r =
/// 0. For the columns of free pose coordinates, J A_r = t.
void null_motion(const Problem& problem, const Posture& posture, Eigen::MatrixXd& A_r);

}  // namespace maxwrench
