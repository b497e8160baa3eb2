#include "maxwrench/posture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lib/robot/kinematics.h"
#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Posture, EndEffectorKeepsItsPose) {
  Random random(1);
  for (int sample = 0; sample < 50; ++sample) {
    const Problem problem = random_problem(random, 4);
    PostureEvaluator model(problem);
    const Posture& posture = model.evaluate(random_theta_r(problem, random));
    ASSERT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
    Kinematics<double> kinematics(problem.robot);
    kinematics.set_joints(posture.q);
    const Pose<double> pose =
        posture.base * kinematics.end_effector(problem.robot.end_effectors[0]);
    EXPECT_LT((pose.p - problem.pose.p).norm(), 1e-14);
    EXPECT_LT((pose.R - problem.pose.R).norm(), 1e-14);
  }
}

TEST(Posture, PullBackEqualsCentralDifferences) {
  Random random(2);
  for (const int joints : {1, 3, 4, 6}) {
    const Problem problem = random_problem(random, joints);
    PostureEvaluator model(problem, false);
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const int n = problem.robot.velocities();
    const Eigen::VectorXd tau_seed =
        Eigen::VectorXd::NullaryExpr(n, [&] { return random.normal(); });
    const Matrix6Xd J_seed =
        Matrix6Xd::NullaryExpr(6, n, [&](Eigen::Index, Eigen::Index) { return random.normal(); });
    Eigen::VectorXd gradient;
    model.pull_back(theta_r, tau_seed, J_seed, gradient);
    const auto value = [&](const Eigen::VectorXd& at) {
      const Posture& posture = model.evaluate(at);
      return tau_seed.dot(posture.tau_d) + J_seed.cwiseProduct(posture.J).sum();
    };
    constexpr double kStep = 1e-6;
    for (int k = 0; k < joints; ++k) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(joints, k);
      const double difference = (value(theta_r + step) - value(theta_r - step)) / (2 * kStep);
      EXPECT_NEAR(gradient[k], difference, 1e-7 * (1 + std::abs(difference)));
    }
  }
}

TEST(Posture, PullBackKeepsTheLastPosture) {
  Random random(4);
  const Problem problem = random_problem(random, 3);
  PostureEvaluator model(problem), fresh(problem);
  const Eigen::VectorXd here = random_theta_r(problem, random);
  const Eigen::VectorXd there = random_theta_r(problem, random);
  const Posture& posture = model.evaluate(here);
  const Matrix6Xd J = posture.J;
  const Eigen::VectorXd t = Eigen::VectorXd::Ones(problem.robot.velocities());
  const Matrix6Xd J_seed = Matrix6Xd::Ones(6, problem.robot.velocities());
  Eigen::VectorXd gradient, expected;
  fresh.pull_back(there, t, J_seed, expected);
  model.pull_back(there, t, J_seed, gradient);
  EXPECT_EQ(gradient, expected);
  EXPECT_EQ(posture.J, J);
  EXPECT_EQ(posture.theta_r, here);
  fresh.pull_back(here, t, J_seed, expected);
  model.pull_back(here, t, J_seed, gradient);
  EXPECT_EQ(gradient, expected);
}

TEST(Posture, PlanarFrames) {
  // Straight arm: tool at (0.5, 0.1) in base axes, tool yaw 10 degrees in the world, so the base
  // has that yaw.
  const Problem problem = load_problem("planar/force");
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(Eigen::Vector2d::Zero());
  ASSERT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
  const double yaw = 10 * M_PI / 180;
  const Eigen::Vector3d base(-(0.5 * std::cos(yaw) - 0.1 * std::sin(yaw)),
                             -(0.5 * std::sin(yaw) + 0.1 * std::cos(yaw)), 0);
  EXPECT_LT((posture.base.p - base).norm(), 1e-14);
  // Surge moves the tool along the hull; yaw moves it across the line from the base origin, which
  // is at -base.
  EXPECT_NEAR(posture.J(0, 0), std::cos(yaw), 1e-14);
  EXPECT_NEAR(posture.J(1, 0), std::sin(yaw), 1e-14);
  EXPECT_NEAR(posture.J(0, 2), base.y(), 1e-14);
  EXPECT_NEAR(posture.J(1, 2), -base.x(), 1e-14);
  EXPECT_NEAR(posture.J(5, 2), 1, 1e-14);
  EXPECT_EQ(posture.tau_d.norm(), 0);
}

TEST(Posture, LimitsReachAndBadNumbers) {
  Random random(3);
  Problem problem = random_problem(random, 2);
  PostureEvaluator model(problem);
  EXPECT_EQ(model.evaluate(Eigen::Vector2d(1.5, -1.5)).status, Status::kValid);
  EXPECT_EQ(model.evaluate(Eigen::Vector2d(1.6, 0)).status, Status::kInvalidPosture);
  EXPECT_STREQ(model.evaluate(Eigen::Vector2d(1.6, 0)).reason.c_str(), "joint limit");
  EXPECT_THROW(model.evaluate(Eigen::Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(model.evaluate(Eigen::Vector2d(NAN, 0)), std::invalid_argument);
  // A base on {x, y, yaw} cannot take the roll and height that this pose asks for.
  problem.robot.base_axes = {0, 1, 5};
  complete_actuation(problem.robot);
  PostureEvaluator planar(problem);
  EXPECT_EQ(planar.evaluate(Eigen::Vector2d::Zero()).status, Status::kInvalidPosture);
}

}  // namespace
}  // namespace maxwrench
