#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "maxwrench/load.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

/// uvms/valve without its file.
TaskSpec valve() {
  static const Robot robot = load_robot(problems_folder() / "uvms/bluerov2_alpha5.toml");
  TaskSpec task{.name = "valve", .robot = robot, .end_effector = "tool"};
  task.c = along(5);
  return task;
}

TaskSpec valve_with(const UncertaintySpec& uncertainty) {
  TaskSpec task = valve();
  task.uncertainty = uncertainty;
  return task;
}

TaskSpec valve_with(const LossSpec& loss) {
  TaskSpec task = valve();
  task.loss = loss;
  return task;
}

std::vector<std::string> names_of_limits(const ScenarioList& list) {
  std::vector<std::string> names;
  for (const ScenarioLimits& each : list.limits) names.push_back(each.name);
  return names;
}

std::vector<std::string> names_of_cases(const LoadGroup& group) {
  std::vector<std::string> names;
  for (const LoadCase& each : group) names.push_back(each.name);
  return names;
}

void expect_load(const LoadCase& one, int link, double mass, const Vector3d& moment) {
  SCOPED_TRACE(one.name);
  ASSERT_EQ(one.loads.size(), 1u);
  EXPECT_EQ(one.loads[0].link, link);
  EXPECT_NEAR(one.loads[0].mass, mass, 1e-15);
  EXPECT_LT((one.loads[0].moment - moment).norm(), 1e-15) << one.loads[0].moment.transpose();
  EXPECT_TRUE(one.current.isZero(0));
}

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
  const Problem problem = make_problem(valve_with(nothing));
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
  EXPECT_THAT(names_of_limits(list), ElementsAre(""));
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

TEST(Scenarios, EveryThrusterMayBeDead) {
  const Problem problem = make_problem(valve_with(LossSpec{.any = 1}));
  const ScenarioList& list = problem.scenarios;
  const Robot& robot = problem.robot;
  ASSERT_EQ(list.limits.size(), 9u);
  EXPECT_EQ(list.limits[0].name, "");
  EXPECT_EQ(list.limits[0].actuation.u_min, robot.actuation.u_min);
  ASSERT_EQ(list.wrenches.size(), 1u);
  EXPECT_EQ(list.wrenches[0].c, along(5));
  EXPECT_STREQ(list.unit, "N m");
  for (std::size_t i = 0; i < 8; ++i) {
    const ScenarioLimits& dead = list.limits[i + 1];
    EXPECT_EQ(dead.name, robot.thrusters[i].name + " dead");
    Eigen::VectorXd u_max = robot.actuation.u_max, u_min = robot.actuation.u_min;
    u_max[static_cast<Eigen::Index>(i)] = u_min[static_cast<Eigen::Index>(i)] = 0;
    EXPECT_EQ(dead.actuation.u_max, u_max);
    EXPECT_EQ(dead.actuation.u_min, u_min);
    EXPECT_EQ(dead.actuation.B, robot.actuation.B);
  }
}

TEST(Scenarios, LossesOfSeveral) {
  LossSpec loss{.any = 2,
                .actuators = {"rear_left_vertical", "q3_elbow", "front_left_vertical"},
                .friction = 0.5};
  ScenarioList list = make_problem(valve_with(loss)).scenarios;
  EXPECT_THAT(names_of_limits(list),
              ElementsAre("", "front_left_vertical dead", "rear_left_vertical dead",
                          "q3_elbow limp", "front_left_vertical dead and rear_left_vertical dead",
                          "front_left_vertical dead and q3_elbow limp",
                          "rear_left_vertical dead and q3_elbow limp"));
  EXPECT_EQ(list.limits[3].actuation.u_min[10], -0.5);
  EXPECT_EQ(list.limits[3].actuation.u_max[10], 0.5);
  loss = {.any = 8};
  EXPECT_EQ(make_problem(valve_with(loss)).scenarios.limits.size(), 256u);  // 2^8
  loss = {
      .cases = {{"q3_elbow", "rear_left_vertical"}, {"joints"}, {"rear_left_vertical", "q3_elbow"}},
      .joints_lock = true};
  list = make_problem(valve_with(loss)).scenarios;
  EXPECT_THAT(names_of_limits(list),
              ElementsAre("", "rear_left_vertical dead and q3_elbow locked",
                          "q1_shoulder_yaw locked and q2_shoulder_pitch locked and q3_elbow "
                          "locked and q4_wrist_roll locked"));
  EXPECT_EQ(list.limits[1].actuation.u_min[10], -kInfinity);
  EXPECT_EQ(list.limits[1].actuation.u_max[10], kInfinity);
  EXPECT_EQ(list.limits[1].actuation.u_max[7], 0);
  EXPECT_EQ(list.limits[1].actuation.u_max[9], 9);
  loss.brake = 20;
  EXPECT_EQ(make_problem(valve_with(loss)).scenarios.limits[1].actuation.u_max[10], 20);
}

TEST(Scenarios, ActuatorsThatMayBeWeaker) {
  UncertaintySpec uncertainty;
  uncertainty.thrust = 0.1;
  uncertainty.torque = 0.25;
  TaskSpec task = valve_with(uncertainty);
  task.loss =
      LossSpec{.any = 1, .actuators = {"front_right_horizontal", "q3_elbow"}, .friction = 0.5};
  const ScenarioList list = make_problem(task).scenarios;
  ASSERT_EQ(list.limits.size(), 3u);
  EXPECT_EQ(list.limits[0].name, "");
  Eigen::VectorXd u_min(12), u_max(12);
  u_min << Eigen::VectorXd::Constant(8, -36), -6.75, -6.75, -6.75, -1.5;
  u_max << Eigen::VectorXd::Constant(8, 45), 6.75, 6.75, 6.75, 1.5;
  EXPECT_LT((list.limits[0].actuation.u_min - u_min).norm(), 1e-13);
  EXPECT_LT((list.limits[0].actuation.u_max - u_max).norm(), 1e-13);
  EXPECT_EQ(list.limits[1].actuation.u_max[0], 0);
  EXPECT_NEAR(list.limits[1].actuation.u_max[1], 45, 1e-13);
  EXPECT_EQ(list.limits[2].actuation.u_max[10], 0.5);  // friction is no weaker
}

/// A thruster that cannot stop: with less thrust it is not in each direction worse.
TEST(Scenarios, LimitsThatExcludeZeroHaveTwoEnds) {
  Robot robot = vehicle();
  robot.thrusters[1].force_min = 0.5;
  robot.thrusters[3].force_max = -0.5;
  TaskSpec task = push(finalize(robot, vehicle_shapes()));
  task.uncertainty.emplace().thrust = 0.2;
  task.loss = LossSpec{.cases = {{"front_right"}}};
  const ScenarioList list = make_problem(task).scenarios;
  EXPECT_THAT(names_of_limits(list),
              ElementsAre("", "front_right 20 % weaker", "rear_right 20 % weaker",
                          "front_right 20 % weaker and rear_right 20 % weaker", "front_right dead",
                          "front_right dead and rear_right 20 % weaker"));
  const auto u = [&](std::size_t i) { return list.limits[i].actuation; };
  EXPECT_EQ(u(0).u_min[1], 0.5);
  EXPECT_EQ(u(0).u_max[1], 1);
  EXPECT_EQ(u(0).u_max[0], 0.8);
  EXPECT_EQ(u(1).u_min[1], 0.4);
  EXPECT_EQ(u(1).u_max[1], 0.8);
  EXPECT_EQ(u(1).u_max[3], -0.5);
  EXPECT_EQ(u(3).u_max[3], -0.4);
  EXPECT_EQ(u(3).u_min[3], -0.8);
  EXPECT_EQ(u(5).u_min[1], 0);
  EXPECT_EQ(u(5).u_max[3], -0.4);
}

TEST(Scenarios, CornersOfMassAndCentre) {
  UncertaintySpec uncertainty;
  uncertainty.mass = {{"link_2", 0.038}};
  uncertainty.com = {{"link_2", {0.01, 0, 0}}};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  ASSERT_EQ(list.loads.size(), 1u);
  const LoadGroup& group = list.loads[0];
  EXPECT_THAT(
      names_of_cases(group),
      ElementsAre("link_2 mass +0.038 kg, com.x +0.01 m", "link_2 mass -0.038 kg, com.x +0.01 m",
                  "link_2 mass +0.038 kg, com.x -0.01 m", "link_2 mass -0.038 kg, com.x -0.01 m"));
  // 0.38 kg at (0.0746, 0.00055, 0) in the file.
  expect_load(group[0], 2, 0.038, {0.418 * 0.0846 - 0.38 * 0.0746, 0.038 * 0.00055, 0});
  expect_load(group[1], 2, -0.038, {0.342 * 0.0846 - 0.38 * 0.0746, -0.038 * 0.00055, 0});
  expect_load(group[2], 2, 0.038, {0.418 * 0.0646 - 0.38 * 0.0746, 0.038 * 0.00055, 0});
  expect_load(group[3], 2, -0.038, {0.342 * 0.0646 - 0.38 * 0.0746, -0.038 * 0.00055, 0});
  ASSERT_EQ(list.limits.size(), 1u);
}

/// The arm's foot is fixed to the vehicle, turned by half a turn about x: its y and z are those of
/// the vehicle with the other sign.
TEST(Scenarios, ABodyOnAFixedJoint) {
  UncertaintySpec uncertainty;
  uncertainty.mass = {{"base", 0.02}};
  uncertainty.cob = {{"base", {0, 0, 0.01}}};
  uncertainty.com = {{"vehicle", {0, 0.01, 0}}};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  ASSERT_EQ(list.loads.size(), 3u);
  // The vehicle's comes first, as in the URDF.
  expect_load(list.loads[0][0], 0, 0, {0, 0.145, 0});
  expect_load(list.loads[1][0], 0, 0.02, 0.02 * Vector3d(0.203 - 0.065, 0, -0.1317));
  EXPECT_EQ(list.loads[1][0].name, "base mass +0.02 kg");
  expect_load(list.loads[2][0], 0, 0, {0, 0, 998 * 0.00016 * 0.01});
  EXPECT_EQ(list.loads[2][0].name, "base cob.z +0.01 m");
}

TEST(Scenarios, BuoyancyCarries) {
  UncertaintySpec uncertainty;
  uncertainty.volume = {{"link_4", 1e-5}};
  uncertainty.cob = {{"link_4", {0, 0.01, 0}}};
  const LoadGroup group = make_problem(valve_with(uncertainty)).scenarios.loads.at(0);
  ASSERT_EQ(group.size(), 4u);
  EXPECT_EQ(group[0].name, "link_4 volume +1e-05 m^3, cob.y +0.01 m");
  expect_load(group[0], 4, -0.00998, -998 * Vector3d(0, 1.44e-4 * 0.01, -1e-5 * 0.1195));
}

TEST(Scenarios, TrimAndAnUnknownPayload) {
  UncertaintySpec uncertainty;
  uncertainty.trim = 0.2;
  uncertainty.payload_mass = 0.5;
  uncertainty.payload_com = {0.05, 0, 0.02};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  ASSERT_EQ(list.loads.size(), 2u);
  EXPECT_THAT(names_of_cases(list.loads[0]), ElementsAre("trim +0.2 kg", "trim -0.2 kg"));
  const Vector3d at(0.086, 0, -0.109);
  expect_load(list.loads[0][0], 0, -0.2, -0.2 * at);
  expect_load(list.loads[0][1], 0, 0.2, 0.2 * at);
  EXPECT_THAT(names_of_cases(list.loads[1]), ElementsAre("", "payload 0.5 kg"));
  EXPECT_TRUE(list.loads[1][0].loads.empty());
  // The tool's x is -z of link 4, its y is x there and its z is -y.
  expect_load(list.loads[1][1], 4, 0.5, 0.5 * Vector3d(0, -0.02, -0.05 - 0.18));
}

TEST(Scenarios, Currents) {
  UncertaintySpec uncertainty;
  uncertainty.current_speed = 0.3;
  uncertainty.current_directions = 8;
  LoadGroup group = make_problem(valve_with(uncertainty)).scenarios.loads.at(0);
  ASSERT_EQ(group.size(), 9u);
  EXPECT_EQ(group[0].name, "");
  EXPECT_TRUE(group[0].current.isZero(0));
  EXPECT_EQ(group[2].name, "current 0.3 m/s at 45 deg");
  const double root = std::sqrt(0.5);
  EXPECT_LT((group[1].current - Vector3d(0.3, 0, 0)).norm(), 1e-15);
  EXPECT_LT((group[2].current - Vector3d(0.3 * root, 0.3 * root, 0)).norm(), 1e-15);
  EXPECT_LT((group[8].current - Vector3d(0.3 * root, -0.3 * root, 0)).norm(), 1e-15);
  uncertainty = {};
  uncertainty.current_vectors = {{0.1, 0, -0.2}, Vector3d::Zero()};
  group = make_problem(valve_with(uncertainty)).scenarios.loads.at(0);
  EXPECT_THAT(names_of_cases(group), ElementsAre("current [0.1, 0, -0.2] m/s", ""));
  EXPECT_EQ(group[0].current, Vector3d(0.1, 0, -0.2));
}

/// The corners of the table of parameters for which values are known: 64.
TEST(Scenarios, ManyCorners) {
  UncertaintySpec uncertainty;
  uncertainty.trim = 0.2;
  uncertainty.cob = {{"vehicle", {0.005, 0, 0.005}}};
  uncertainty.mass = {{"link_2", 0.038}, {"link_4", 0.1}};
  uncertainty.com = {{"link_2", {0.01, 0, 0}}};
  const ScenarioList list = make_problem(valve_with(uncertainty)).scenarios;
  std::vector<std::size_t> sizes;
  for (const LoadGroup& group : list.loads) sizes.push_back(group.size());
  EXPECT_THAT(sizes, ElementsAre(4u, 2u, 4u, 2u));
  EXPECT_STREQ(list.unit, "N m");
  EXPECT_FALSE(list.non_negative);
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
