#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

/// Orthonormal columns that span as many dimensions as there are, all of them across `others`.
void expect_across(const Matrix6Xd& F, int columns, const Matrix6Xd& others) {
  ASSERT_EQ(F.cols(), columns);
  EXPECT_LT((F.transpose() * F - Eigen::MatrixXd::Identity(columns, columns)).norm(), 1e-14);
  EXPECT_LT((others.transpose() * F).norm(), 1e-14);
}

TEST(Scenarios, OneWrenchOfAKnownRobotIsNoList) {
  EXPECT_TRUE(make_problem(valve()).scenarios.empty());
  UncertaintySpec nothing;
  nothing.mass = {{"link_4", 0}};
  nothing.com = {{"link_4", Vector3d::Zero()}};
  nothing.current_vectors = {Vector3d::Zero()};
  TaskSpec task = valve();
  task.uncertainty = nothing;
  const Problem problem = make_problem(task);
  EXPECT_TRUE(problem.scenarios.empty());
  EXPECT_TRUE(problem.scenarios.limits.empty());
  EXPECT_TRUE(problem.scenarios.loads.empty());
  EXPECT_EQ(problem.scenarios.F.cols(), 0);
  EXPECT_EQ(problem.W_any, make_problem(valve()).W_any);
  EXPECT_STREQ(problem.unit(), "N m");
}

TEST(Scenarios, ASetKeepsItsLengths) {
  TaskSpec task = valve();
  task.c.setZero();
  task.set = {10 * along(0), -2 * along(5)};
  const Problem problem = make_problem(task);
  const ScenarioList& list = problem.scenarios;
  ASSERT_EQ(list.wrenches.size(), 2u);
  EXPECT_EQ(list.wrenches[0].name, "wrench 1");
  EXPECT_EQ(list.wrenches[0].c, 10 * along(0));
  EXPECT_EQ(list.wrenches[1].name, "wrench 2");
  EXPECT_EQ(list.wrenches[1].c, -2 * along(5));
  EXPECT_EQ(problem.c, along(0));
  EXPECT_STREQ(problem.unit(), "-");
  EXPECT_FALSE(list.non_negative);
  EXPECT_THAT(limit_names(list), ElementsAre(""));
  EXPECT_EQ(list.limits[0].actuation.u_max, problem.robot.actuation.u_max);
  EXPECT_EQ(list.limits[0].actuation.b_max, problem.robot.actuation.b_max);
}

/// Even one wrench is a list if it comes from a set.
TEST(Scenarios, ASetOfOneIsAList) {
  TaskSpec task = valve();
  task.c.setZero();
  task.set = {3 * along(1)};
  EXPECT_STREQ(make_problem(task).unit(), "-");
  task.set = {along(1)};
  EXPECT_STREQ(make_problem(task).unit(), "N");
  task.set = {along(1), -along(2)};
  EXPECT_STREQ(make_problem(task).unit(), "N");
  task.set = {along(4)};
  EXPECT_STREQ(make_problem(task).unit(), "N m");
  task.set = {along(1), along(4)};
  EXPECT_STREQ(make_problem(task).unit(), "-");
}

TEST(Scenarios, HoldAddsAWrenchOfZero) {
  TaskSpec task = valve();
  task.c *= 4;
  task.hold = true;
  const Problem problem = make_problem(task);
  ASSERT_EQ(problem.scenarios.wrenches.size(), 2u);
  EXPECT_EQ(problem.scenarios.wrenches[0].name, "");
  EXPECT_EQ(problem.scenarios.wrenches[0].c, along(5));  // c is a direction
  EXPECT_FALSE(problem.scenarios.wrenches[0].hold);
  EXPECT_EQ(problem.scenarios.wrenches[1].name, "hold");
  EXPECT_TRUE(problem.scenarios.wrenches[1].c.isZero(0));
  EXPECT_TRUE(problem.scenarios.wrenches[1].hold);
  EXPECT_STREQ(problem.unit(), "N m");
}

/// The tool's axes at the pose: x along the world's y.
TEST(Scenarios, WrenchesInTheEndEffectorsAxes) {
  TaskSpec task = valve();
  task.pose = yaw_turn(std::numbers::pi / 2);
  task.wrench_in_end_effector = true;
  task.c.setZero();
  task.set = {2 * along(0), along(4)};
  task.ball_axes = {"fy"};
  task.ball_radius = 0.5;
  const ScenarioList list = make_problem(task).scenarios;
  EXPECT_LT((list.wrenches[0].c - 2 * along(1)).norm(), 1e-15);
  EXPECT_LT((list.wrenches[1].c + along(3)).norm(), 1e-15);
  EXPECT_LT((list.ball->E + along(0)).norm(), 1e-15);
}

TEST(Scenarios, ABallAlone) {
  TaskSpec task = valve();
  task.c.setZero();
  task.ball_axes = {"fz", "fy"};
  task.ball_radius = 1;
  const Problem problem = make_problem(task);
  const ScenarioList& list = problem.scenarios;
  ASSERT_EQ(list.wrenches.size(), 1u);
  EXPECT_EQ(list.wrenches[0].name, "ball");
  EXPECT_TRUE(list.wrenches[0].c.isZero(0));
  EXPECT_FALSE(list.wrenches[0].hold);
  ASSERT_EQ(list.ball->E.cols(), 2);
  EXPECT_EQ(list.ball->E.col(0), along(2));
  EXPECT_EQ(list.ball->E.col(1), along(1));
  EXPECT_EQ(list.ball->radius, 1);
  EXPECT_EQ(problem.c, along(2));
  EXPECT_TRUE(list.non_negative);
  EXPECT_STREQ(problem.unit(), "N");
  task.ball_radius = 2;
  EXPECT_STREQ(make_problem(task).unit(), "-");
  task.ball_axes = {"tx"};
  task.ball_radius = 1;
  EXPECT_STREQ(make_problem(task).unit(), "N m");
}

/// A cone about a direction has the unit of the direction if the ball has it too.
TEST(Scenarios, ABallBesideADirection) {
  TaskSpec task = valve();
  task.c = 7 * along(0);
  task.ball_axes = {"fy", "fz"};
  task.ball_radius = 0.364;
  const Problem problem = make_problem(task);
  ASSERT_EQ(problem.scenarios.wrenches.size(), 1u);
  EXPECT_EQ(problem.scenarios.wrenches[0].name, "");
  EXPECT_EQ(problem.scenarios.wrenches[0].c, along(0));
  EXPECT_EQ(problem.c, along(0));
  EXPECT_STREQ(problem.unit(), "N");
  EXPECT_TRUE(problem.scenarios.non_negative);
  task.ball_axes = {"tz"};
  EXPECT_STREQ(make_problem(task).unit(), "-");
}

TEST(Scenarios, FreeIsWhatLiesAcrossAllWrenches) {
  TaskSpec task = valve();
  task.c.setZero();
  task.set = {10 * along(0), 3 * along(0) + 2 * along(1)};
  Problem problem = make_problem(task);
  Matrix6Xd others(6, 2);
  others << along(0), along(1);
  expect_across(problem.scenarios.F, 4, others);
  EXPECT_EQ(problem.W_any.cols(), 6);
  task.set = {along(0) + along(5), -5 * along(0) - 5 * along(5)};  // one line
  problem = make_problem(task);
  expect_across(problem.scenarios.F, 5, along(0) + along(5));
  task.set = {along(0), along(1)};
  task.any = {"fx", "fy", "tz"};
  expect_across(make_problem(task).scenarios.F, 1, others);
  EXPECT_LT((make_problem(task).scenarios.F.cwiseAbs() - along(5)).norm(), 1e-15);
  task.ball_axes = {"tz"};
  task.ball_radius = 1;
  EXPECT_EQ(make_problem(task).scenarios.F.cols(), 0);
}

/// In the plane fx, fy and tz do work; a part of a wrench that does none is not free.
TEST(Scenarios, FreeIsWhatDoesWork) {
  TaskSpec task = push();
  task.any.reset();
  task.c.setZero();
  task.set = {along(0), along(0) + 2 * along(2)};
  const Problem problem = make_problem(task);
  Matrix6Xd others(6, 4);
  others << along(0), along(2), along(3), along(4);
  expect_across(problem.scenarios.F, 2, others);
}

/// 1 kg of steel at (0.05, 0, 0.02) m on the tool of uvms/lift, whose axes are the world's: the
/// water carries 998/7850 of its weight.
TEST(Scenarios, APayload) {
  TaskSpec task = valve();
  task.c.setZero();
  task.payload = PayloadSpec{.com = {0.05, 0, 0.02}, .volume = 1.0 / 7850};
  const Problem problem = make_problem(task);
  const ScenarioList& list = problem.scenarios;
  ASSERT_EQ(list.wrenches.size(), 1u);
  EXPECT_EQ(list.wrenches[0].name, "");
  Vector6d c;
  c << 0, 0, 9.81 * (1 - 998.0 / 7850), 0, -0.05 * 9.81 * (1 - 998.0 / 7850), 0;
  EXPECT_LT((list.wrenches[0].c - c).norm(), 1e-14);
  EXPECT_NEAR(list.wrenches[0].c[2], 8.562818, 1e-6);
  EXPECT_NEAR(list.payload->wet_mass, 1 - 998.0 / 7850, 1e-15);
  EXPECT_LT((problem.c - c.normalized()).norm(), 1e-15);
  EXPECT_STREQ(problem.unit(), "kg");
  EXPECT_TRUE(list.non_negative);
  expect_across(list.F, 5, c);
}

/// A load whose buoyancy acts elsewhere, on a tool whose x is the world's y.
TEST(Scenarios, APayloadTurnedWithTheTool) {
  TaskSpec task = valve();
  task.pose = yaw_turn(std::numbers::pi / 2);
  task.c.setZero();
  task.payload = PayloadSpec{.com = {0.05, 0, 0}, .volume = 0.001, .cob = {{0.15, 0, 0.3}}};
  const ScenarioList list = make_problem(task).scenarios;
  EXPECT_NEAR(list.payload->wet_mass, 0.002, 1e-15);
  const Vector3d moment(0.05 - 0.998 * 0.15, 0, -0.998 * 0.3);
  EXPECT_LT((list.payload->moment - moment).norm(), 1e-15);
  Vector6d c;
  c << 0, 0, 9.81 * 0.002, 9.81 * moment.x(), 0, 0;
  EXPECT_LT((list.wrenches[0].c - c).norm(), 1e-14);
}

TEST(Scenarios, APayloadThatFloats) {
  TaskSpec task = valve();
  task.c.setZero();
  task.payload = PayloadSpec{.volume = 0.002};
  const Problem problem = make_problem(task);
  EXPECT_NEAR(problem.scenarios.wrenches[0].c[2], -0.996 * 9.81, 1e-14);
  EXPECT_EQ(problem.c, -along(2));
}

}  // namespace
}  // namespace maxwrench
