#pragma once

#include <algorithm>
#include <numbers>

#include "lib/kinematics.h"
#include "lib/random.h"

namespace maxwrench {

/// Singular values below this part of the largest are rounding.
inline constexpr double kRankTolerance = 1e-9;

/// The largest rank(kinematics) over some random positions of all joints: almost everywhere it is
/// as large as it can be. Unlimited joints; the base rests.
template <class Rank>
int generic_rank(const Robot& robot, Rank&& rank) {
  constexpr int kPostures = 8;
  Random random(1);
  Kinematics<double> kinematics(robot);
  Eigen::VectorXd q(robot.joints.size());
  Eigen::Index largest = 0;
  for (int posture = 0; posture < kPostures; ++posture) {
    for (double& q_i : q) q_i = random.uniform(-std::numbers::pi, std::numbers::pi);
    kinematics.set_joints(q);
    largest = std::max<Eigen::Index>(largest, rank(kinematics));
  }
  return static_cast<int>(largest);
}

}  // namespace maxwrench
