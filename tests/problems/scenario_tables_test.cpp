#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>

#include "maxwrench/load.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::ElementsAre;

/// A task of the uvms with these tables beside its pose.
Problem load_tables(const std::string& tables) {
  const TemporaryFolder folder;
  const std::filesystem::path robot = problems_folder() / "uvms/bluerov2_alpha5.toml";
  const std::filesystem::path file = folder.path() / "task.toml";
  std::ofstream(file) << "type = 'static'\nrobot = '" << robot.string()
                      << "'\nend_effector = 'tool'\nlabel = 'l'\nsource = 's'\n"
                         "pose = { xyz = [0, 0, 0], rpy = [0, 0, 0] }\n"
                      << tables;
  return load_problem(file.string());
}

/// The same task in code.
TaskSpec coded() {
  TaskSpec task{.robot = load_robot(problems_folder() / "uvms/bluerov2_alpha5.toml"),
                .end_effector = "tool"};
  task.c = along(5);
  return task;
}

void expect_same_list(const ScenarioList& a, const ScenarioList& b) {
  ASSERT_EQ(a.wrenches.size(), b.wrenches.size());
  for (std::size_t i = 0; i < a.wrenches.size(); ++i) {
    EXPECT_EQ(a.wrenches[i].name, b.wrenches[i].name);
    EXPECT_EQ(a.wrenches[i].c, b.wrenches[i].c);
    EXPECT_EQ(a.wrenches[i].hold, b.wrenches[i].hold);
  }
  EXPECT_EQ(a.ball.has_value(), b.ball.has_value());
  EXPECT_EQ(a.F, b.F);
  EXPECT_STREQ(a.unit, b.unit);
  ASSERT_EQ(a.limits.size(), b.limits.size());
  for (std::size_t i = 0; i < a.limits.size(); ++i) {
    EXPECT_EQ(a.limits[i].name, b.limits[i].name);
    EXPECT_EQ(a.limits[i].actuation.u_min, b.limits[i].actuation.u_min);
    EXPECT_EQ(a.limits[i].actuation.u_max, b.limits[i].actuation.u_max);
  }
  ASSERT_EQ(a.loads.size(), b.loads.size());
  for (std::size_t i = 0; i < a.loads.size(); ++i) {
    ASSERT_EQ(a.loads[i].size(), b.loads[i].size());
    for (std::size_t k = 0; k < a.loads[i].size(); ++k) {
      const LoadCase &in_a = a.loads[i][k], &in_b = b.loads[i][k];
      EXPECT_EQ(in_a.name, in_b.name);
      EXPECT_EQ(in_a.current, in_b.current);
      ASSERT_EQ(in_a.loads.size(), in_b.loads.size());
      for (std::size_t l = 0; l < in_a.loads.size(); ++l) {
        EXPECT_EQ(in_a.loads[l].mass, in_b.loads[l].mass);
        EXPECT_EQ(in_a.loads[l].moment, in_b.loads[l].moment);
        EXPECT_EQ(in_a.loads[l].link, in_b.loads[l].link);
      }
    }
  }
}

TEST(ScenarioTables, SetBallAndHold) {
  const Problem problem = load_tables(
      "[wrench]\nset = [[0,0,-10, 0,0,5], [10,0,0, 0,0,0]]\nhold = true\n"
      "ball = { axes = ['fy', 'fz'], radius = 0.364 }\n");
  TaskSpec task = coded();
  task.c.setZero();
  task.set = {-10 * along(2) + 5 * along(5), 10 * along(0)};
  task.ball_axes = {"fy", "fz"};
  task.ball_radius = 0.364;
  task.hold = true;
  expect_same_list(problem.scenarios, make_problem(task).scenarios);
  EXPECT_EQ(problem.scenarios.ball->E.cols(), 2);
  EXPECT_EQ(problem.scenarios.ball->radius, 0.364);
}

TEST(ScenarioTables, Uncertainty) {
  const Problem problem = load_tables(
      "wrench.c = [0, 0, 0, 0, 0, 1]\n"
      "[uncertainty]\nsource = 'weighed'\nmass.link_4 = 0.1\nmass.vehicle = '2.5%'\n"
      "com.link_2 = [0.01, 0, 0]\ncob.vehicle = [0.005, 0, 0.005]\nvolume.base = '5%'\ntrim = 0.2\n"
      "payload.mass = 0.5\npayload.com = [0, 0, 0.1]\nthrust = 0.1\ntorque = 0.2\n"
      "current = { speed = 0.3, directions = 4 }\n");
  TaskSpec task = coded();
  UncertaintySpec& u = task.uncertainty.emplace();
  u.mass = {{"link_4", 0.1}, {"vehicle", 0.025 * 14.5}};
  u.com = {{"link_2", {0.01, 0, 0}}};
  u.cob = {{"vehicle", {0.005, 0, 0.005}}};
  u.volume = {{"base", 0.05 * 0.00016}};
  u.trim = 0.2;
  u.payload_mass = 0.5;
  u.payload_com = {0, 0, 0.1};
  u.thrust = 0.1;
  u.torque = 0.2;
  u.current_speed = 0.3;
  u.current_directions = 4;
  expect_same_list(problem.scenarios, make_problem(task).scenarios);
  ASSERT_EQ(problem.scenarios.loads.size(), 8u);
  EXPECT_EQ(problem.scenarios.loads[0][0].name, "vehicle mass +0.3625 kg");
  const ScenarioList currents = load_tables(
                                    "wrench.c = [0, 0, 0, 0, 0, 1]\n"
                                    "uncertainty.current.vectors = [[0.1, 0, 0], [0, 0, 0]]\n")
                                    .scenarios;
  EXPECT_EQ(currents.loads[0][0].current, Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(load_tables("wrench.c = [0, 0, 0, 0, 0, 1]\nuncertainty.current.speed = 1\n")
                .scenarios.loads[0]
                .size(),
            73u);
}

TEST(ScenarioTables, Loss) {
  const std::string wrench = "wrench.c = [0, 0, 0, 0, 0, 1]\n[loss]\n";
  TaskSpec task = coded();
  task.loss = LossSpec{.any = 1};
  expect_same_list(load_tables(wrench + "any = 1\n").scenarios, make_problem(task).scenarios);
  task.loss = LossSpec{.any = 2, .actuators = {"joints", "front_left_vertical"}, .friction = 0.5};
  expect_same_list(load_tables(wrench + "any = 2\nactuators = ['joints', 'front_left_vertical']\n"
                                        "joints = 'limp'\nfriction = 0.5\n")
                       .scenarios,
                   make_problem(task).scenarios);
  task.loss = LossSpec{.cases = {{"front_left_vertical"}, {"q3_elbow", "rear_left_vertical"}},
                       .joints_lock = true,
                       .brake = 30};
  expect_same_list(load_tables(wrench + "cases = [['front_left_vertical'], ['q3_elbow', "
                                        "'rear_left_vertical']]\njoints = 'locked'\nbrake = 30\n")
                       .scenarios,
                   make_problem(task).scenarios);
}

TEST(ScenarioTables, Payload) {
  const Problem problem = load_tables(
      "[payload]\ncom = [0.05, 0, 0.02]\nvolume_per_kg = 1.274e-4\ncob = [0.05, 0, 0]\n"
      "inertia_per_kg = [0.002, 0.002, 0.002, 0, 0, 0]\n"
      "added_mass_per_kg = [0.064, 0.064, 0.064, 0, 0, 0]\n");
  TaskSpec task = coded();
  task.c.setZero();
  task.payload = PayloadSpec{.com = {0.05, 0, 0.02}, .volume = 1.274e-4, .cob = {{0.05, 0, 0}}};
  const Problem same = make_problem(task);
  expect_same_list(problem.scenarios, same.scenarios);
  EXPECT_EQ(problem.scenarios.payload->moment, same.scenarios.payload->moment);
  EXPECT_STREQ(problem.unit(), "kg");
}

/// Tasks of one URDF have digests of their own, and one wrench keeps the digest that it had.
TEST(ScenarioTables, DigestsOfTasksOfAUrdf) {
  const std::filesystem::path urdf = problems_folder() / "planar/vehicle.urdf";
  std::vector<std::string> digests;
  const auto add = [&](const std::function<void(TaskSpec&)>& change) {
    TaskSpec task;
    task.pose.p = {0.4, 0.1, 0};
    task.c = along(0);
    change(task);
    digests.push_back(make_urdf_problem(urdf, {.base_axes = {0, 1, 5}}, task).digest);
  };
  const auto with_set = [](const Vector6d& c) {
    return [c](TaskSpec& t) {
      t.c.setZero();
      t.set = {c};
    };
  };
  const auto with = [](const UncertaintySpec& u) {
    return [u](TaskSpec& t) { t.uncertainty = u; };
  };
  add([](TaskSpec&) {});
  add(with_set(along(0)));
  add(with_set(along(0) * (1 + 1e-15)));
  add([](TaskSpec& t) { t.hold = true; });
  add([](TaskSpec& t) { t.ball_axes = {"fy"}, t.ball_radius = 0.5; });
  add([](TaskSpec& t) { t.ball_axes = {"fy"}, t.ball_radius = 0.25; });
  UncertaintySpec u;
  u.mass = {{"hull", 1}};
  add(with(u));
  u.mass = {{"link_1", 0.01}};
  add(with(u));
  u.com = {{"hull", {0.1, 0, 0}}};
  add(with(u));
  u.payload_mass = 1;
  add(with(u));
  u.payload_com.z() = 1;
  add(with(u));
  u.trim = 1;
  add(with(u));
  u.thrust = 0.1;
  add(with(u));
  u.thrust = 0, u.torque = 0.1;
  add(with(u));
  add([](TaskSpec& t) { t.loss = LossSpec{.any = 1}; });
  add([](TaskSpec& t) { t.loss = LossSpec{.any = 2}; });
  add([](TaskSpec& t) { t.loss = LossSpec{.any = 1, .actuators = {"joints"}}; });
  add([](TaskSpec& t) {
    t.loss = LossSpec{.any = 1, .actuators = {"joints"}, .joints_lock = true};
  });
  add([](TaskSpec& t) { t.loss = LossSpec{.any = 1, .actuators = {"joints"}, .friction = 1}; });
  add([](TaskSpec& t) { t.loss = LossSpec{.cases = {{"shoulder"}, {"elbow"}}}; });
  add([](TaskSpec& t) { t.loss = LossSpec{.cases = {{"shoulder", "elbow"}}}; });
  std::sort(digests.begin(), digests.end());
  EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
}

}  // namespace
}  // namespace maxwrench
