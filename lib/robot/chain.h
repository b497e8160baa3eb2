#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include "lib/math/random.h"
#include "lib/robot/kinematics.h"

namespace maxwrench {

/// The joints of the chain from the base to an end effector, from the base outward.
std::vector<int> chain_to(const Robot& robot, int end_effector);

/// These joints and all that they carry, from the base outward.
std::vector<int> carried_by(const Robot& robot, const std::vector<int>& joints);

/// In how many independent ways the free base axes and the joints of the chain move an end
/// effector: the largest rank of their columns of J over all postures, 6 in space and 3 in a plane.
/// A pose leaves (free base axes + joints of the chain - this number) coordinates free: theta_r.
int motions_of(const Robot& robot, int end_effector);
/// The same for these velocities alone.
int motions_of(const Robot& robot, int end_effector, const std::vector<int>& velocities);

/// [x, y, z, yaw] of a base that neither rolls nor pitches -> its pose in the world: the robot's
/// mount, then (x, y, z), then Rz(yaw).
Pose<double> base_pose(const Robot& robot, const Eigen::Vector4d& x);

/// Distance [m] and rotation [-] below which the base counts as lying on its free axes.
inline constexpr double kReachTolerance = 1e-9;

/// Whether a pose in the world is reached by moving along the free base axes from the mount.
bool base_reaches(const Robot& robot, const Pose<double>& in_world);

/// All joints at zero, or at the limit next to it.
Eigen::VectorXd resting_joints(const Robot& robot);

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
