#include "lib/robot/dynamics_slopes.h"

#include <gtest/gtest.h>

#include <functional>

#include "lib/robot/dynamics.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Everything that tau_d + J'h_e depends on.
struct Argument {
  Eigen::Matrix3d R_base;
  VectorXd q, v, v_dot;
  Vector6d h_e;
};

Argument random_argument(const Robot& robot, Random& random) {
  const int n = robot.velocities();
  return {random_rotation(random), random_numbers(random, static_cast<int>(robot.joints.size())),
          random_numbers(random, n), random_numbers(random, n), random_numbers(random, 6)};
}

/// The definition, by the recursive algorithm.
VectorXd loads(const Robot& robot, const Argument& at) {
  Dynamics dynamics(robot);
  dynamics.set_configuration(at.R_base, at.q);
  VectorXd tau_d(robot.velocities());
  dynamics.inverse(at.v, at.v_dot, tau_d);
  Matrix6Xd J;
  dynamics.kinematics().jacobian(robot.end_effectors[0], at.R_base, J);
  return tau_d + J.transpose() * at.h_e;
}

using Move = std::function<void(Argument&, Eigen::Index, double)>;

void expect_slopes(const Robot& robot, const Argument& at, const MatrixXd& slopes, const Move& move,
                   double tolerance) {
  const double step = 1e-5;
  for (Eigen::Index j = 0; j < slopes.cols(); ++j) {
    Argument up = at, down = at;
    move(up, j, step);
    move(down, j, -step);
    const VectorXd differences = (loads(robot, up) - loads(robot, down)) / (2 * step);
    EXPECT_LT((slopes.col(j) - differences).norm(), tolerance * (1 + differences.norm())) << j;
  }
}

void expect_all_slopes(const Robot& robot, const Argument& at, double tolerance) {
  DynamicsSlopes slopes(robot);
  slopes.set(at.R_base, at.q, at.v, at.v_dot, robot.end_effectors[0], at.h_e);
  const auto turn = [](Argument& a, Eigen::Index axis, double step) {
    a.R_base *= Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  };
  const auto add = [](VectorXd Argument::*part) {
    return [part](Argument& a, Eigen::Index i, double step) { (a.*part)[i] += step; };
  };
  expect_slopes(robot, at, slopes.by_turn(), turn, tolerance);
  expect_slopes(robot, at, slopes.by_q(), add(&Argument::q), tolerance);
  expect_slopes(robot, at, slopes.by_v(), add(&Argument::v), tolerance);
  expect_slopes(robot, at, slopes.by_v_dot(), add(&Argument::v_dot), tolerance);
}

TEST(DynamicsSlopes, AreThoseOfTheRecursiveAlgorithm) {
  Random random(31);
  for (int sample = 0; sample < 30; ++sample) {
    const Robot robot = random_wet_robot(random, 1 + sample % 7);
    expect_all_slopes(robot, random_argument(robot, random), 1e-7);
  }
}

TEST(DynamicsSlopes, OfABaseThatMovesInSomeWaysOnly) {
  Random random(32);
  for (const std::vector<int>& axes : {std::vector<int>{}, {0, 1, 5}, {2, 4}}) {
    Robot robot = random_wet_robot(random, 5);
    robot.base_axes = axes;
    expect_all_slopes(robot, random_argument(robot, random), 1e-7);
  }
}

TEST(DynamicsSlopes, InACurrent) {
  Random random(36);
  for (const std::vector<int>& axes :
       {std::vector<int>{0, 1, 2, 3, 4, 5}, {}, {0, 1, 5}, {2, 4}, {5}}) {
    Robot robot = random_wet_robot(random, 4);
    robot.base_axes = axes;
    robot.current = random_numbers(random, 3);
    expect_all_slopes(robot, random_argument(robot, random), 1e-7);
  }
}

TEST(DynamicsSlopes, OfAToolOnTheBaseOrHalfWayUp) {
  Random random(33);
  for (int link = 0; link < 5; ++link) {
    Robot robot = random_wet_robot(random, 5);
    robot.end_effectors[0].link = link;
    expect_all_slopes(robot, random_argument(robot, random), 1e-7);
  }
}

/// |v| v has the derivative 2 |v| there, which is zero: differences of step h see h instead.
TEST(DynamicsSlopes, WhereTheDragChangesSign) {
  Random random(34);
  const Robot robot = random_wet_robot(random, 5);
  Argument rest = random_argument(robot, random);
  rest.v.setZero();
  expect_all_slopes(robot, rest, 1e-4);
}

TEST(DynamicsSlopes, AllocateNothing) {
  Random random(35);
  const Robot robot = random_wet_robot(random, 6);
  const Argument at = random_argument(robot, random);
  DynamicsSlopes slopes(robot);
  const long before = allocation_count();
  slopes.set(at.R_base, at.q, at.v, at.v_dot, robot.end_effectors[0], at.h_e);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace maxwrench
