#include "tests/support/dependents.h"

#include <algorithm>

#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "tests/support/support.h"

namespace maxwrench {

Problem problem_with_dependents(Random& random, const std::vector<int>& axes, int redundancy,
                                bool turns) {
  const int joints = 6 - static_cast<int>(axes.size()) + redundancy;
  Problem problem = random_problem(random, joints);
  Robot& robot = problem.robot;
  robot.base_axes = axes;
  robot.mount = {random_rotation(random), random_vector(random)};
  for (Joint& joint : robot.joints) {
    joint.q_min = -20;
    joint.q_max = 20;
    // A sliding joint would repeat a translation of the base.
    if (turns || axes.size() >= 3) joint.type = JointType::kRevolute;
  }
  complete_actuation(robot);
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  for (const int axis : axes) x[std::min(axis, 3)] = random.uniform(-1, 1);
  Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(joints, [&] { return random.uniform(-1, 1); });
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  problem.pose = base_pose(robot, x) * kinematics.end_effector(robot.end_effectors[0]);
  problem.redundant.clear();
  for (int i = 0; i < joints; ++i) {
    (i >= joints - redundancy ? problem.redundant : problem.dependent).push_back(i);
  }
  problem.theta_r_default = q.tail(redundancy);
  problem.theta_r_min = problem.theta_r_default.array() - 0.4;
  problem.theta_r_max = problem.theta_r_default.array() + 0.4;
  problem.guess_q =
      q + Eigen::VectorXd::NullaryExpr(joints, [&] { return 0.05 * random.normal(); });
  problem.guess_base = x;
  return problem;
}

Problem four_bars() {
  Problem problem;
  Robot& robot = problem.robot;
  robot.links.resize(5);
  for (int i = 0; i < 4; ++i) {
    Joint joint;
    joint.parent = i;
    joint.placement.p = Eigen::Vector3d(i == 0 ? 0 : 1, 0, 0);
    joint.q_min = -3;
    joint.q_max = 3;
    robot.joints.push_back(joint);
  }
  robot.end_effectors = {{"tool", 4, {}}};
  complete_actuation(robot);
  problem.pose.p = {1.5, 0.5, 0};
  problem.redundant = {0};
  problem.dependent = {1, 2, 3};
  problem.theta_r_min = Eigen::VectorXd::Constant(1, -3);
  problem.theta_r_max = Eigen::VectorXd::Constant(1, 3);
  problem.theta_r_default = Eigen::VectorXd::Constant(1, 0.5);
  problem.guess_q = Eigen::Vector4d(0.5, -0.5, 1.5, 0);
  return problem;
}

double pose_error(const Problem& problem, const Posture& posture) {
  const EndEffector& end_effector = problem.robot.end_effectors[0];
  const Pose<double> pose = posture.base *
                            posture.links[static_cast<std::size_t>(end_effector.link)] *
                            end_effector.placement;
  return std::max((pose.p - problem.pose.p).norm(), (pose.R - problem.pose.R).norm());
}

const Posture& nearest_ik_solution(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                                   const Eigen::VectorXd& q) {
  model.evaluate(theta_r);
  int nearest = -1;
  double least = kInfinity;
  for (int i = 0; i < model.ik_solutions(); ++i) {
    const double away = (model.select(i).q - q).norm();
    if (away >= least) continue;
    least = away;
    nearest = i;
  }
  return nearest < 0 ? model.evaluate(theta_r) : model.select(nearest);
}

}  // namespace maxwrench
