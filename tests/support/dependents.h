#pragma once

#include <vector>

#include "lib/math/random.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The sets of base axes that leave dependent joints.
inline const std::vector<std::vector<int>> kIntegrableAxes = {
    {}, {0}, {0, 1}, {0, 1, 2}, {5}, {0, 1, 5}, {0, 1, 2, 5}};

/// A robot with these base axes, mounted anywhere, and a chain of random joints, `redundancy` of
/// them redundant. Its pose is that of random joint positions, and the guess is near them. With
/// `turns`, all joints are revolute.
Problem problem_with_dependents(Random& random, const std::vector<int>& axes, int redundancy,
                                bool turns = false);

/// A fixed arm with four links of 1, 1, 1 and 0 m that turn about z. The first joint is redundant.
/// The tool is held at (1.5, 0.5) m, along x.
Problem four_bars();

/// The error of the posture from the problem's pose, in [m] or of the rotation matrix.
double pose_error(const Problem& problem, const Posture& posture);

/// The posture at theta_r whose joints are nearest to q.
const Posture& nearest_ik_solution(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                                   const Eigen::VectorXd& q);

}  // namespace maxwrench
