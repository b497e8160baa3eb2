#pragma once

#include "tests/support/support.h"

namespace maxwrench {

/// The shipped problems with a second contact that exerts forces.
inline constexpr const char* kContactProblems[] = {"dual_arm/bar_wall", "dual_arm/two_arms",
                                                   "planar/two_arms"};

/// Near the default, where many postures are valid.
Eigen::VectorXd near_default(const Problem& problem, Random& random);

/// dual_arm/two_arms with theta_r within this of the best posture that `solve` finds from each of
/// 20 seeds, 87.857 N m.
Problem two_arms_about_the_best(double width);
constexpr double kBestOfTwoArms = 87.8569;

/// The same task, touching a pipe: C_2 turns with the regrasp coordinate.
Problem with_pipe(Problem problem);

/// A random vehicle. Its first arm has four joints; its second arm has six revolute joints and
/// holds a rod: any wrench, one regrasp coordinate.
Problem with_firm_grasp(Random& random);

}  // namespace maxwrench
