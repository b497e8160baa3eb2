#pragma once

#include <vector>

#include "lib/math/random.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The sets of base axes that leave joints to follow.
inline const std::vector<std::vector<int>> kIntegrableAxes = {
    {}, {0}, {0, 1}, {0, 1, 2}, {5}, {0, 1, 5}, {0, 1, 2, 5}};

/// A robot with these base axes, mounted anywhere, and a chain of random joints, `redundancy` of
/// them redundant; its pose is that of random joint positions, and the guess is near them. `turns`:
/// all joints are revolute.
Problem problem_with_dependents(Random& random, const std::vector<int>& axes, int redundancy,
                                bool turns = false);

/// A fixed arm of four links of 1, 1, 1 and 0 m that turn about z: the first joint is redundant.
/// The tool is held at (1.5, 0.5) m, along x.
Problem four_bars();

/// How far the posture is from the problem's pose, [m] or of the rotation matrix.
double pose_error(const Problem& problem, const Posture& posture);

/// Of the postures at theta_r, that whose joints are nearest to q.
const Posture& nearest_ik_solution(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                                   const Eigen::VectorXd& q);

}  // namespace maxwrench
