#pragma once

#include "tests/support/support.h"

namespace maxwrench {

/// The shipped problems with a second contact that exerts something.
inline constexpr const char* kContactProblems[] = {"dual_arm/bar_wall", "dual_arm/two_arms",
                                                   "planar/two_arms"};

/// Near the default, where many postures are valid.
Eigen::VectorXd near_default(const Problem& problem, Random& random);

/// The same task, touching a pipe instead: C_2 turns with the regrasp coordinate.
Problem with_pipe(Problem problem);

/// A random vehicle whose first arm has four joints and whose second has six revolute ones, which
/// hold on to a rod: any wrench, one regrasp coordinate.
Problem with_firm_grasp(Random& random);

}  // namespace maxwrench
