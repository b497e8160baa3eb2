#include "tests/support/contacts.h"

#include <algorithm>

#include "lib/robot/kinematics.h"

namespace maxwrench {
namespace {

void append_coordinate(Problem& problem, Eigen::Index others, double start, double most) {
  for (Eigen::VectorXd* v : {&problem.theta_r_default, &problem.theta_r_min, &problem.theta_r_max})
    v->conservativeResize(others + 1);
  problem.theta_r_default[others] = start;
  problem.theta_r_min[others] = -most;
  problem.theta_r_max[others] = most;
}

}  // namespace

Eigen::VectorXd near_default(const Problem& problem, Random& random) {
  Eigen::VectorXd theta_r = problem.theta_r_default;
  for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
    const double width = 0.3 * (problem.theta_r_max[i] - problem.theta_r_min[i]);
    theta_r[i] = std::clamp(theta_r[i] + std::min(width, 0.15) * random.uniform(-1, 1),
                            problem.theta_r_min[i], problem.theta_r_max[i]);
  }
  return theta_r;
}

Problem two_arms_about_the_best(double width) {
  Problem task = load_problem("dual_arm/two_arms");
  Eigen::VectorXd best(5);
  best << 6.02, 2.25346, 2.15090, 3.04743, 0.02973;
  task.theta_r_min = (best.array() - width).max(task.theta_r_min.array());
  task.theta_r_max = (best.array() + width).min(task.theta_r_max.array());
  task.theta_r_default = best.cwiseMax(task.theta_r_min).cwiseMin(task.theta_r_max);
  return task;
}

Problem with_pipe(Problem problem) {
  Contact& contact = *problem.contact;
  const int others = problem.redundancy() - contact.coordinates();
  contact.surface = Surface::kCircle;
  contact.radius = 0.08;
  contact.frame.p += contact.radius * contact.frame.R.col(2);
  append_coordinate(problem, others, 0.1, 1);
  return problem;
}

Problem with_firm_grasp(Random& random) {
  constexpr int kFirst = 4, kSecond = 6;
  Problem problem = random_problem(random, kFirst);
  Robot& robot = problem.robot;
  Contact contact;
  for (int i = 0; i < kSecond; ++i) {
    Link link;
    link.mass = random.uniform(0.5, 2);
    link.com = random_vector(random, 0.1);
    link.volume = random.uniform(0, 0.002);
    link.cob = random_vector(random, 0.1);
    robot.links.push_back(link);
    Joint joint;
    joint.parent = i == 0 ? 0 : kFirst + i;
    joint.placement = {random_rotation(random), random_vector(random, 0.3)};
    joint.axis = random_vector(random).normalized();
    joint.q_min = -3;
    joint.q_max = 3;
    joint.effort_max = random.uniform(5, 15);
    robot.joints.push_back(joint);
    contact.follow.push_back(kFirst + i);
  }
  robot.end_effectors.push_back(
      {"hand", kFirst + kSecond, {random_rotation(random), random_vector(random, 0.2)}});
  complete_actuation(robot);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(kFirst + kSecond);
  for (const int i : contact.follow) q[i] = random.uniform(-1, 1);
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  const Pose<double> base =
      problem.pose * kinematics.end_effector(robot.end_effectors[0]).inverse();
  contact.frame = base * kinematics.end_effector(robot.end_effectors[1]);
  contact.end_effector = 1;
  contact.surface = Surface::kLine;
  contact.holds_axes = true;
  contact.C = Matrix6Xd::Identity(6, 6);
  contact.w_min = Eigen::VectorXd::Constant(6, -kInfinity);
  contact.w_max = Eigen::VectorXd::Constant(6, kInfinity);
  contact.q_rest = Eigen::VectorXd::Zero(q.size());
  contact.sigma_min = 1e-3;
  contact.rank = stacked_rank(robot, 0, contact);
  problem.contact = contact;
  append_coordinate(problem, kFirst, 0, 0.1);
  return problem;
}

}  // namespace maxwrench
