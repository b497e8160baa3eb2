#include "solvers/certify/bound/exact_posture.h"

#include <numeric>

#include "lib/math/rotated.h"
#include "lib/posture/free_pose.h"
#include "lib/robot/chain.h"

namespace maxwrench {

ExactPosture::ExactPosture(const Problem& problem)
    : problem_(problem),
      joints_(moved_joints(problem)),
      kinematics_(problem.robot),
      q_((problem.contact ? problem.contact->q_rest : resting_joints(problem.robot))
             .cast<Extended>()) {}

void ExactPosture::set(const ExtendedVector& theta_r) {
  const EndEffector& tip =
      problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(theta_r.size(), joints_.size()); ++i) {
    const int joint = joints_[static_cast<std::size_t>(i)];
    if (joint >= 0) q_[joint] = theta_r[i];
  }
  kinematics_.set_joints(q_);
  const Matrix3<Extended> R_e = kinematics_.end_effector(tip).R;
  pose_ = free_pose(problem_, theta_r);
  const Matrix3<Extended> R_base = pose_.R * R_e.transpose();
  kinematics_.jacobian(tip, R_base, J_);
  kinematics_.gravity_and_buoyancy(R_base, tau_d_);
}

std::vector<int> moved_joints(const Problem& problem) {
  std::vector<int> joints = problem.redundant;
  joints.resize(static_cast<std::size_t>(problem.redundancy()), -1);
  joints.insert(joints.end(), problem.dependent.begin(), problem.dependent.end());
  if (problem.contact) {
    const std::vector<int>& follow = problem.contact->follow;
    joints.insert(joints.end(), follow.begin(), follow.end());
  }
  return joints;
}

Matrix6X<Extended> exact_turned(const Problem& problem, const Pose<Extended>& pose,
                                const Matrix6Xd& wrenches) {
  const Matrix6X<Extended> given = wrenches.cast<Extended>();
  if (!problem.free.wrench_turns) return given;
  const Matrix3<Extended> turn = pose.R * problem.pose.R.cast<Extended>().transpose();
  return rotated(turn, given);
}

Coordinates all_coordinates(const Problem& problem) {
  Coordinates all;
  all.index.resize(problem.redundant.size());
  std::iota(all.index.begin(), all.index.end(), 0);
  for (const int joint : problem.redundant) {
    const Joint& at = problem.robot.joints[static_cast<std::size_t>(joint)];
    all.turns.push_back(at.type == JointType::kRevolute);
  }
  for (const int axis : problem.free.axes) {
    all.index.push_back(all.count());
    all.turns.push_back(axis >= 3);
  }
  return all;
}

}  // namespace maxwrench
