#include "lib/posture/given_posture.h"

#include <algorithm>

#include "lib/posture/free_pose.h"
#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

/// The kind of the first violation of a joint limit.
Violation beyond_limits(const Problem& problem, const Eigen::VectorXd& q) {
  Violation found = Violation::kNone;
  for (std::size_t i = 0; i < problem.robot.joints.size(); ++i) {
    const Joint& joint = problem.robot.joints[i];
    const double q_i = q[static_cast<Eigen::Index>(i)];
    if (q_i >= joint.q_min - kLimitTolerance && q_i <= joint.q_max + kLimitTolerance) continue;
    const auto& redundant = problem.redundant;
    if (std::find(redundant.begin(), redundant.end(), static_cast<int>(i)) != redundant.end()) {
      return Violation::kThetaR;
    }
    found = Violation::kDependentJoint;
  }
  return found;
}

}  // namespace

Problem held_at_joints(const Problem& problem, const Eigen::VectorXd& q) {
  Problem held = held_at(problem, problem.theta_r_default);
  held.c = problem.c;  // at the pose of the task
  held.W_any = problem.W_any;
  held.wrench_axes = problem.wrench_axes;
  held.scenarios = problem.scenarios;
  held.pose = pose_at_mount(problem.robot, problem.end_effector, q);
  held.start_system.reset();
  if (problem.wrench_in_end_effector) {
    turn_wrenches(held.pose.R * problem.pose.R.transpose(), held);
  }
  return held;
}

Posture given_posture(const Problem& held, const Eigen::VectorXd& q, bool check_collision) {
  const Robot& robot = held.robot;
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  Posture posture;
  posture.theta_r = q(held.redundant);
  posture.base = robot.mount;
  posture.q = q;
  posture.links = kinematics.links();
  posture.J.resize(6, robot.velocities());
  posture.tau_d.resize(robot.velocities());
  kinematics.jacobian(robot.end_effectors[static_cast<std::size_t>(held.end_effector)],
                      robot.mount.R, posture.J);
  kinematics.gravity_and_buoyancy(robot.mount.R, posture.tau_d);
  posture.violation = beyond_limits(held, q);
  const bool collides =
      check_collision && robot.collision && robot.collision->collides(posture.links);
  if (posture.violation != Violation::kNone) {
    posture.conclude(Status::kInvalidPosture, "joint limit");
  } else if (collides) {
    posture.violation = Violation::kCollision;
    posture.conclude(Status::kInvalidPosture, "self-collision");
  } else {
    posture.conclude(Status::kValid);
  }
  return posture;
}

}  // namespace maxwrench
