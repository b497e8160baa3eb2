#pragma once

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "lib/math/random.h"
#include "lib/robot/kinematics.h"

namespace maxwrench {

/// The joints of the chain from the base to an end effector, from the base outward.
std::vector<int> chain_to(const Robot& robot, int end_effector);

/// These joints and all joints that they carry, from the base outward.
std::vector<int> carried_by(const Robot& robot, const std::vector<int>& joints);

/// The number of independent motions that the free base axes and the joints of the chain give an
/// end effector: the largest rank of their columns of J over all postures, 6 in space and 3 in a
/// plane. A pose leaves (free base axes + joints of the chain - this number) coordinates free:
/// theta_r.
int motions_of(const Robot& robot, int end_effector);
/// The same for these velocities alone.
int motions_of(const Robot& robot, int end_effector, const std::vector<int>& velocities);

/// The pose in the world of a base that neither rolls nor pitches, from x = [x, y, z, yaw]: the
/// robot's mount, then (x, y, z), then Rz(yaw).
Pose<double> base_pose(const Robot& robot, const Eigen::Vector4d& x);

/// The base lies on its free axes if the distance [m] and the rotation [-] from them are below
/// this.
inline constexpr double kReachTolerance = 1e-9;

/// Whether the base reaches a pose in the world by moving along its free axes from the mount.
bool base_reaches(const Robot& robot, const Pose<double>& in_world);

/// The joint positions with each joint at zero, or at its limit nearest to zero.
Eigen::VectorXd resting_joints(const Robot& robot);

/// Sets the joints that gears move, from those that lead.
void apply_gears(const Robot& robot, Eigen::VectorXd& q);

/// Draws the positions of all joints, each within its limits; those that gears move follow.
void draw_joints(const Robot& robot, Random& random, Eigen::VectorXd& q);

/// The joint of this name; -1 if there is none.
int find_joint(const Robot& robot, const std::string& name);

/// The name of actuator i: thrusters come first, then joints.
const std::string& actuator_name(const Robot& robot, Eigen::Index i);

/// The pose in the world of an end effector at the joint positions q, with the base at its mount.
Pose<double> pose_at_mount(const Robot& robot, int end_effector, const Eigen::VectorXd& q);

/// Singular values below this share of the largest count as zero.
inline constexpr double kRankTolerance = 1e-9;

/// The largest rank(kinematics) over random positions of all joints; almost all positions attain
/// the maximum. Joint limits are ignored and the base rests.
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
