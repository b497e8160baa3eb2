#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "lib/posture/free_pose.h"
#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The posture that a workspace moves, with what computes it.
struct PostureState : Posture {
  explicit PostureState(const Problem& p) : problem(p), pose(p.pose), kinematics(p.robot) {
    theta_r.setConstant(p.redundancy(), kNothing);
    J.setZero(6, p.robot.velocities());
    J_2.setZero(6, p.contact ? p.robot.velocities() : 0);
    tau_d.setZero(p.robot.velocities());
    q = p.contact ? p.contact->q_rest : resting_joints(p.robot);
    if (p.contact) second = carried_by(p.robot, p.contact->follow);
    for (int i = 0; i < static_cast<int>(p.robot.joints.size()); ++i) {
      if (!std::binary_search(second.begin(), second.end(), i)) first.push_back(i);
    }
  }

  const EndEffector& end_effector() const {
    return problem.robot.end_effectors[problem.end_effector];
  }

  /// Evaluates the posture if the base is the only dependent coordinate: all joints of the chain
  /// give it in closed form.
  void evaluate(const Eigen::VectorXd& at) {
    theta_r = at;
    for (std::size_t i = 0; i < problem.redundant.size(); ++i) {
      q[problem.redundant[i]] = at[static_cast<Eigen::Index>(i)];
    }
    apply_gears(problem.robot, q);
    kinematics.set_joints(q, first);
    if (!problem.free.axes.empty()) pose = pose_at(problem, at);
    base = pose * kinematics.end_effector(end_effector()).inverse();
    finish();
  }

  /// Evaluates the posture at z = [x, y, z, yaw of the base; all joints].
  void evaluate_at(const Eigen::VectorXd& at, const Eigen::VectorXd& z) {
    theta_r = at;
    if (!problem.free.axes.empty()) pose = pose_at(problem, at);
    q = z.tail(q.size());
    apply_gears(problem.robot, q);
    kinematics.set_joints(q, first);
    base = base_pose(problem.robot, z.head<4>());
    finish();
  }

  void finish() {
    kinematics.jacobian(end_effector(), base.R, J);
    if (!problem.contact) kinematics.gravity_and_buoyancy(base.R, tau_d);
  }

  /// The same for a second arm that has moved, without tau_d.
  void finish_second() {
    kinematics.set_joints(q, second);
    const auto touching = static_cast<std::size_t>(problem.contact->end_effector);
    kinematics.jacobian(problem.robot.end_effectors[touching], base.R, J_2);
  }

  /// The theta_r before the first evaluation; equal to no theta_r.
  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

  const Problem& problem;
  Pose<double> pose;  ///< of the end effector, X(s)
  Kinematics<double> kinematics;
  std::vector<int> second;  ///< the joints that move with a second arm's IK solution
  std::vector<int> first;   ///< all others
};

}  // namespace maxwrench
