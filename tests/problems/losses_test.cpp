#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maxwrench/capability.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using testing::ElementsAre;

TaskSpec valve_with(const LossSpec& loss) {
  TaskSpec task = valve();
  task.loss = loss;
  return task;
}

TEST(Losses, EveryThrusterMayBeDead) {
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

/// A scenario names its actuators: those that are lost, and by which share others are weaker.
TEST(Losses, ScenariosNameTheirActuators) {
  TaskSpec spec = valve_with({.cases = {{"q3_elbow", "rear_left_vertical"}}, .friction = 0.5});
  spec.uncertainty = UncertaintySpec{.thrust = 0.1};
  const auto data_of = [](const TaskSpec& task, int limits) {
    const Problem problem = make_problem(task);
    ScenarioChoice choice;
    choice.limits = limits;
    choice.cases.resize(problem.scenarios.loads.size());
    return scenario_data(problem, choice);
  };
  ScenarioData data = data_of(spec, 1);
  EXPECT_THAT(data.dead, ElementsAre("rear_left_vertical"));
  EXPECT_THAT(data.limp, ElementsAre("q3_elbow"));
  EXPECT_THAT(data.locked, ElementsAre());
  EXPECT_EQ(data.weaker.size(), 7u);
  for (const auto& [name, share] : data.weaker) {
    EXPECT_EQ(share, 0.1);
    EXPECT_NE(name, "rear_left_vertical");
  }
  EXPECT_FALSE(data.current);
  EXPECT_EQ(data_of(spec, 0).weaker.size(), 8u);
  data = data_of(valve_with({.cases = {{"joints"}}, .joints_lock = true}), 1);
  EXPECT_EQ(data.locked.size(), 4u);
  EXPECT_THAT(data.limp, ElementsAre());
}

TEST(Losses, LossesOfSeveral) {
  LossSpec loss{.any = 2,
                .actuators = {"rear_left_vertical", "q3_elbow", "front_left_vertical"},
                .friction = 0.5};
  ScenarioList list = make_problem(valve_with(loss)).scenarios;
  EXPECT_THAT(limit_names(list),
              ElementsAre("", "front_left_vertical dead", "rear_left_vertical dead",
                          "q3_elbow limp", "front_left_vertical dead and rear_left_vertical dead",
                          "front_left_vertical dead and q3_elbow limp",
                          "rear_left_vertical dead and q3_elbow limp"));
  EXPECT_EQ(list.limits[3].actuation.u_min[10], -0.5);
  EXPECT_EQ(list.limits[3].actuation.u_max[10], 0.5);
  loss = {.any = 7};
  EXPECT_EQ(make_problem(valve_with(loss)).scenarios.limits.size(), 255u);  // 2^8 - 1
  loss = {
      .cases = {{"q3_elbow", "rear_left_vertical"}, {"joints"}, {"rear_left_vertical", "q3_elbow"}},
      .joints_lock = true};
  list = make_problem(valve_with(loss)).scenarios;
  EXPECT_THAT(limit_names(list),
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

TEST(Losses, ActuatorsThatMayBeWeaker) {
  UncertaintySpec uncertainty;
  uncertainty.thrust = 0.1;
  uncertainty.torque = 0.25;
  TaskSpec task = valve();
  task.uncertainty = uncertainty;
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
TEST(Losses, LimitsThatExcludeZeroHaveTwoEnds) {
  Robot robot = vehicle();
  robot.thrusters[1].force_min = 0.5;
  robot.thrusters[3].force_max = -0.5;
  TaskSpec task = push(finalize(robot, vehicle_shapes()));
  task.uncertainty.emplace().thrust = 0.2;
  task.loss = LossSpec{.cases = {{"front_right"}}};
  const ScenarioList list = make_problem(task).scenarios;
  EXPECT_THAT(limit_names(list),
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

}  // namespace
}  // namespace maxwrench
