#include "tests/support/loops.h"

#include <cmath>
#include <numbers>

#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "problems/loader/drives.h"
#include "tests/support/dependents.h"
#include "tests/support/free_poses.h"

namespace maxwrench {

Problem loop_problem(const std::string& name) {
  if (name.rfind("random, ", 0) != 0) return load_problem(name);
  Random random(3);
  if (name == "random, fixed") {
    Problem problem = problem_with_dependents(random, {}, 1);
    for (Joint& joint : problem.robot.joints) joint.effort_max *= 20;  // bears its weight
    complete_actuation(problem.robot);
    return problem;
  }
  if (name == "random, x") return problem_with_dependents(random, {0}, 1);
  if (name == "random, yaw") return problem_with_dependents(random, {5}, 1);
  if (name == "random, x y z yaw") return problem_with_dependents(random, {0, 1, 2, 5}, 2);
  if (name == "random, parked") return parked_problem(random);
  const Problem problem = problem_with_dependents(random, {0, 1, 5}, 2);
  if (name == "random, x y yaw") return problem;
  return with_free_pose(problem, {{1, 3, 5}, true, true});
}

std::string loop_name(const testing::TestParamInfo<const char*>& of) {
  std::string name = of.param;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

namespace {

/// The rotation, in base axes, of a joint's link from where the joint rests.
Eigen::Matrix3d turned_from_rest(const Robot& robot, int joint, const Eigen::VectorXd& q) {
  const auto link = static_cast<std::size_t>(joint) + 1;
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(resting_joints(robot));
  const Eigen::Matrix3d rest = kinematics.links()[link].R;
  kinematics.set_joints(q);
  return kinematics.links()[link].R * rest.transpose();
}

}  // namespace

Problem parked_problem(Random& random) {
  Problem problem = problem_with_dependents(random, {0, 1, 5}, 2, true);
  Robot& robot = problem.robot;
  robot.thrusters.clear();
  add_brakes(robot);
  Joint& first = robot.joints.front();
  first.axis = Eigen::Vector3d::UnitZ();
  first.placement.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
  for (Joint& joint : robot.joints) joint.effort_max *= 20;  // bears its weight
  complete_actuation(robot);
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(problem.guess_q);
  problem.pose =
      base_pose(robot, problem.guess_base) * kinematics.end_effector(robot.end_effectors.front());
  problem.redundant = {0, 4};
  problem.dependent = {1, 2, 3};
  problem.theta_r_default = Eigen::Vector2d(problem.guess_q[0], problem.guess_q[4]);
  problem.theta_r_min = problem.theta_r_default - Eigen::Vector2d(2, 0.4);
  problem.theta_r_max = problem.theta_r_default + Eigen::Vector2d(1, 0.4);
  return problem;
}

Eigen::VectorXd loop_coordinates(const Problem& problem, const LoopCoordinates& coordinates,
                                 const Posture& posture, const Eigen::VectorXd& w, double t) {
  Eigen::VectorXd x(coordinates.lower.size());
  Eigen::Index next = problem.redundancy();
  x.head(next) = posture.theta_r;
  for (const int joint : problem.dependent) x[next++] = posture.q[joint];
  if (problem.contact) {
    for (const int joint : problem.contact->follow) x[next++] = posture.q[joint];
  }
  if (coordinates.yaw.count() > 0) {
    Eigen::Matrix3d R = problem.robot.mount.R.transpose() * posture.base.R;
    if (coordinates.resting) R *= turned_from_rest(problem.robot, *coordinates.resting, posture.q);
    x[next++] = std::atan2(R(1, 0), R(0, 0));
  }
  for (Eigen::Index k = 0; k < coordinates.w_min.size(); ++k) {
    const double low = coordinates.w_min[k] + t * coordinates.v_min[k];
    const double high = coordinates.w_max[k] + t * coordinates.v_max[k];
    x[next++] = (w[k] - low) / (high - low);
  }
  constexpr double kWholeTurn = 2 * std::numbers::pi;
  for (int i = 0; i < coordinates.chain.count(); ++i) {
    if (!coordinates.chain.turns[static_cast<std::size_t>(i)]) continue;
    double& angle = x[coordinates.chain.index[static_cast<std::size_t>(i)]];
    const int at = coordinates.chain.index[static_cast<std::size_t>(i)];
    if (angle < coordinates.lower[at] - 1e-9) angle += kWholeTurn;
    if (angle > coordinates.upper[at] + 1e-9) angle -= kWholeTurn;
  }
  return x;
}

ContactForces forces_in_bound(const Problem& problem, const std::string& measure) {
  const bool of_base = measure == "linf_polytope" && base_determines_forces(problem);
  return of_base ? ContactForces::kOfBase : ContactForces::kShares;
}

PostureSource::PostureSource(const Problem& problem, const std::string& measure,
                             ContactForces forces, Wrench wrench)
    : problem_(problem),
      coordinates_(problem, forces, left_out_coordinate(problem, measure, wrench)),
      model_(problem),
      program_(make_wrench_program(problem, wrench)),
      measure_(find_measure(measure).make(
          problem,
          find_wrench_solver(problem.contact || program_.columns() > 1 ? "condensed" : "facets")
              .make())) {}

const ValuedPosture* PostureSource::draw(Random& random) {
  model_.evaluate(random_theta_r(problem_, random));
  if (model_.ik_solutions() == 0) return nullptr;
  const auto ik_solution = static_cast<int>(random.uniform(0, model_.ik_solutions()));
  const Posture& posture = model_.select(ik_solution);
  set_posture(posture, program_);
  measure_->evaluate(posture, program_, true, capability_);
  if (capability_.status != Status::kOptimal) return nullptr;
  posture_.value = capability_.beta;
  posture_.x = loop_coordinates(problem_, coordinates_, posture,
                                capability_.w.tail(problem_.contact_columns()), posture_.value);
  return &posture_;
}

}  // namespace maxwrench
