#include <gtest/gtest.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <limits>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/kdl_chain.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

const std::filesystem::path kRobots =
    std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "tests/data/robots";

/// A UR10 that lifts, in a posture of its own choice.
Problem lifting_arm(bool in_tool_axes = false) {
  TaskSpec task;
  task.name = "lift";
  task.posture.emplace();
  task.c = Vector6d::Unit(2);
  task.wrench_in_end_effector = in_tool_axes;
  return make_urdf_problem(kRobots / "ur10/ur10.urdf", {.tool = "tool0"}, task);
}

Eigen::VectorXd joints(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}

/// The largest force along c by KDL's Jacobian and gravity: joint i is driven directly, so its
/// effort is tau_i + (J'c)_i beta.
double kdl_capability(const Robot& robot, const Eigen::VectorXd& q, const Vector6d& c) {
  const KDL::Chain chain = kdl_chain(robot);
  KDL::JntArray at(static_cast<unsigned>(q.size())), gravity(at.rows());
  at.data = q;
  KDL::ChainDynParam(chain, KDL::Vector(0, 0, -robot.gravity)).JntToGravity(at, gravity);
  KDL::Jacobian J(at.rows());
  KDL::ChainJntToJacSolver(chain).JntToJac(at, J);
  const Eigen::VectorXd slope = J.data.transpose() * c;
  double beta = kInfinity;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double effort = robot.joints[static_cast<std::size_t>(i)].effort_max;
    if (std::abs(slope[i]) < 1e-12) continue;
    beta = std::min(beta, ((slope[i] > 0 ? effort : -effort) - gravity.data[i]) / slope[i]);
  }
  return beta;
}

TEST(GivenPosture, HasTheCapabilityThatKdlImplies) {
  const Problem problem = lifting_arm();
  // The second one is stretched: no inverse kinematics would give it.
  for (const Eigen::VectorXd& q :
       {joints({0.3, -1, 1.2, -0.5, 1.1, 0.2}), joints({0, 0, 0, 0, 0, 0})}) {
    const Answer answer = evaluate_posture(problem, q);
    ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.c_str();
    EXPECT_NEAR(answer.beta(), kdl_capability(problem.robot, q, Vector6d::Unit(2)), 1e-8);
    EXPECT_EQ(answer.posture.q, q);
    EXPECT_LT(answer.residual().balance, 1e-9);
    KDL::Frame tip;
    KDL::JntArray at(6);
    at.data = q;
    const KDL::Chain chain = kdl_chain(problem.robot);
    KDL::ChainFkSolverPos_recursive(chain).JntToCart(at, tip);
    EXPECT_LT((answer.task->pose.p - Eigen::Vector3d(tip.p.data)).norm(), 1e-12);
  }
}

/// A force along the tool's z axis, wherever the tool points.
TEST(GivenPosture, WrenchesTurnWithTheTool) {
  const Problem problem = lifting_arm(true);
  const Eigen::VectorXd q = joints({0.3, -1, 1.2, -0.5, 1.1, 0.2});
  const Answer answer = evaluate_posture(problem, q);
  ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.c_str();
  Vector6d c = Vector6d::Zero();
  c.head<3>() = answer.task->pose.R.col(2);
  EXPECT_LT((answer.task->c - c).norm(), 1e-12);
  EXPECT_NEAR(answer.beta(), kdl_capability(problem.robot, q, c), 1e-8);
  EXPECT_LT((answer.capability.h.head<3>() - answer.beta() * c.head<3>()).norm(), 1e-8);
}

/// The posture that `evaluate` finds has the same value if its joints are given, with each measure.
TEST(GivenPosture, AgreesWithThePostureOfThetaR) {
  const Problem problem = load_problem((kRobots / "panda/push.toml").string());
  for (const char* measure : {"linf_polytope", "l2_polytope", "ellipsoid", "manipulability"}) {
    Options options;
    options.measure = measure;
    const Answer by_theta_r = evaluate(problem, problem.theta_r_default, options);
    const Answer by_joints = evaluate_posture(problem, by_theta_r.posture.q, options);
    ASSERT_EQ(by_joints.status, Status::kOptimal) << by_joints.reason.c_str();
    EXPECT_NEAR(by_joints.beta(), by_theta_r.beta(), 1e-8 * std::abs(by_theta_r.beta())) << measure;
    EXPECT_EQ(by_joints.trajectory.gradient.size(), 0);
  }
}

TEST(GivenPosture, LimitsAndCollisionsCount) {
  const Problem problem = load_problem((kRobots / "panda/push.toml").string());
  Eigen::VectorXd q = evaluate(problem, problem.theta_r_default).posture.q;
  q[1] = 9;
  Answer answer = evaluate_posture(problem, q);
  EXPECT_EQ(answer.status, Status::kInvalidPosture);
  EXPECT_NE(answer.reason.str().find("panda_joint2 at 9 rad"), std::string::npos)
      << answer.reason.c_str();
  EXPECT_FALSE(answer.has_value());
  q = joints({0, 0, 0, -1.5, 0, 0, 0});  // the hand touches the arm
  answer = evaluate_posture(problem, q);
  EXPECT_NE(answer.reason.str().find("self-collision: "), std::string::npos)
      << answer.reason.c_str();
  Options options;
  options.check_collision = false;
  EXPECT_TRUE(evaluate_posture(problem, q, options).has_value());
}

void expect_refused(const Problem& problem, const Eigen::VectorXd& q, const std::string& why) {
  try {
    evaluate_posture(problem, q);
    FAIL() << "expected an exception: " << why;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(GivenPosture, RejectsOtherTasksAndOtherSizes) {
  const Problem arm = load_problem("fixed/push");
  expect_refused(arm, Eigen::VectorXd::Zero(3), "joints: got 3 numbers, expected 7");
  expect_refused(arm, Eigen::VectorXd::Constant(7, std::numeric_limits<double>::infinity()),
                 "not a finite number");
  const Problem in_time = load_problem("planar/trajectory");
  expect_refused(in_time, Eigen::VectorXd::Zero(2), "a static task");
  const Problem two = load_problem("planar/two_arms");
  expect_refused(two, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(two.robot.joints.size())),
                 "a second contact");
}

}  // namespace
}  // namespace maxwrench
