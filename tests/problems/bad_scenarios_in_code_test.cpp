#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <ostream>

#include "maxwrench/load.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

struct BadList {
  const char* name;
  std::function<void(TaskSpec&)> spoil;
  const char* message;
};

void PrintTo(const BadList& bad, std::ostream* out) { *out << bad.name; }

/// planar/force: a vehicle in air, on which gravity does not act.
const std::vector<BadList> kBadLists = {
    {"set_beside_c", [](TaskSpec& t) { t.set = {along(0)}; },
     "wrench.c: got [1, 0, 0, 0, 0, 0], expected no such key beside wrench.set"},
    {"set_nan",
     [](TaskSpec& t) {
       t.c.setZero();
       t.set = {along(0), along(1) * kNan};
     },
     "wrench.set[1]: got [nan, nan"},
    {"set_infinite",
     [](TaskSpec& t) {
       t.c.setZero();
       t.set = {Vector6d::Constant(kInfinity)};
     },
     "wrench.set[0]: got [inf, inf"},
    {"set_zero",
     [](TaskSpec& t) {
       t.c.setZero();
       t.set = {1e-10 * along(0)};
     },
     "wrench.set[0]: got [1e-10, 0, 0, 0, 0, 0], expected a wrench of nonzero length"},
    {"set_of_no_work",
     [](TaskSpec& t) {
       t.c.setZero();
       t.any.reset();
       t.set = {along(0), along(2)};
     },
     "wrench.set[1]: got [0, 0, 1, 0, 0, 0], expected a direction that does work"},
    {"ball_of_no_work",
     [](TaskSpec& t) {
       t.any.reset();
       t.ball_axes = {"fy", "fz"};
       t.ball_radius = 1;
     },
     "wrench.ball.axes: got ['fy', 'fz'], expected a direction that does work"},
    {"ball_without_axes", [](TaskSpec& t) { t.ball_radius = 1; },
     "wrench.ball.axes: got [], expected some of fx, fy"},
    {"ball_radius_nan", [](TaskSpec& t) { t.ball_axes = {"fy"}, t.ball_radius = kNan; },
     "wrench.ball.radius: got nan, expected a number > 0"},
    {"ball_radius_infinite", [](TaskSpec& t) { t.ball_axes = {"fy"}, t.ball_radius = kInfinity; },
     "wrench.ball.radius: got inf, expected a number > 0, at most 1e+09"},
    {"hold_alone", [](TaskSpec& t) { t.c.setZero(), t.hold = true; },
     "wrench.c: got [0, 0, 0, 0, 0, 0], expected a direction of nonzero length"},
    {"mass_nan",
     [](TaskSpec& t) {
       t.uncertainty.emplace().mass = {{"hull", kNan}};
     },
     "uncertainty.mass.hull: got nan, expected a finite number"},
    {"com_of_a_body_without_mass",
     [](TaskSpec& t) {
       t.robot.parts[1].mass = 0;
       t.uncertainty.emplace().com = {{"link_1", {0, 0.1, 0}}};
     },
     "uncertainty.com.link_1: got [0, 0.1, 0], expected zeros: this body has no mass"},
    {"com_nan",
     [](TaskSpec& t) {
       t.uncertainty.emplace().com = {{"hull", {0, kNan, 0}}};
     },
     "uncertainty.com.hull: got [0, nan, 0], expected a list of 3 finite numbers"},
    {"volume_in_air",
     [](TaskSpec& t) {
       t.uncertainty.emplace().volume = {{"hull", 0}};
     },
     "uncertainty.volume.hull: got a value, expected no such key in air"},
    {"cob_in_air",
     [](TaskSpec& t) {
       t.uncertainty.emplace().cob = {{"hull", {0, 0, 0}}};
     },
     "uncertainty.cob.hull: got a value, expected no such key in air"},
    {"trim_infinite", [](TaskSpec& t) { t.uncertainty.emplace().trim = kInfinity; },
     "uncertainty.trim: got inf, expected a finite number"},
    {"payload_mass_infinite", [](TaskSpec& t) { t.uncertainty.emplace().payload_mass = kInfinity; },
     "uncertainty.payload.mass: got inf"},
    {"payload_com_nan", [](TaskSpec& t) { t.uncertainty.emplace().payload_com.y() = kNan; },
     "uncertainty.payload.com: got [0, nan, 0]"},
    {"thrust_nan", [](TaskSpec& t) { t.uncertainty.emplace().thrust = kNan; },
     "uncertainty.thrust: got nan, expected a share from 0 to 1, below 1"},
    {"current_in_air", [](TaskSpec& t) { t.uncertainty.emplace().current_speed = 0.3; },
     "uncertainty.current: got 0.3 m/s, expected no such key unless the robot has hydrodynamics"},
    {"current_vector_in_air",
     [](TaskSpec& t) {
       t.uncertainty.emplace().current_vectors = {{0.1, 0, 0}};
     },
     "uncertainty.current: got [0.1, 0, 0], expected no such key unless"},
    {"current_nan",
     [](TaskSpec& t) {
       t.uncertainty.emplace().current_vectors = {{kNan, 0, 0}};
     },
     "uncertainty.current.vectors[0]: got [nan, 0, 0]"},
    {"current_of_both_kinds",
     [](TaskSpec& t) {
       t.uncertainty.emplace().current_vectors = {{0.1, 0, 0}};
       t.uncertainty->current_speed = 1;
     },
     "uncertainty.current.speed: got 1, expected no such key beside"},
    {"loss_of_nothing", [](TaskSpec& t) { t.loss.emplace(); },
     "loss.any: got 0, expected a whole number from 1 to 4, the number of actuators"},
    {"loss_cases_beside_any",
     [](TaskSpec& t) { t.loss = LossSpec{.any = 1, .cases = {{"elbow"}}}; },
     "loss.cases: got 1 cases, expected no such key beside loss.any"},
    {"loss_case_of_nothing", [](TaskSpec& t) { t.loss = LossSpec{.cases = {{}}}; },
     "loss.cases[0]: got [], expected 'thrusters', 'joints' or some of front_left"},
    {"loss_friction_infinite",
     [](TaskSpec& t) { t.loss = LossSpec{.any = 1, .friction = kInfinity}; },
     "loss.friction: got inf, expected a finite number"},
    {"loss_brake_nan", [](TaskSpec& t) { t.loss = LossSpec{.any = 1, .brake = kNan}; },
     "loss.brake: got nan, expected a number > 0"},
    {"payload_beside_c", [](TaskSpec& t) { t.payload.emplace(); },
     "wrench.c: got a value, expected no such key beside payload"},
    {"payload_beside_set",
     [](TaskSpec& t) {
       t.payload.emplace();
       t.c.setZero();
       t.set = {along(0)};
     },
     "wrench.set: got a value, expected no such key beside payload"},
    {"payload_beside_ball",
     [](TaskSpec& t) {
       t.payload.emplace();
       t.c.setZero();
       t.ball_axes = {"fx"};
     },
     "wrench.ball: got a value, expected no such key beside payload"},
    {"payload_beside_hold", [](TaskSpec& t) { t.payload.emplace(), t.c.setZero(), t.hold = true; },
     "wrench.hold: got a value, expected no such key beside payload"},
    {"payload_volume_in_air", [](TaskSpec& t) { t.payload.emplace().volume = 1e-4, t.c.setZero(); },
     "payload.volume_per_kg: got 0.0001, expected no such key in air"},
    {"payload_far_away",
     [](TaskSpec& t) {
       t.payload.emplace().com.x() = 1e300;
       t.c.setZero();
       t.robot.gravity = 9.81;
     },
     "payload.com: got [1e+300, 0, 0], expected numbers of at most 1e+09"},
    {"payload_in_tool_axes",
     [](TaskSpec& t) { t.payload.emplace(), t.c.setZero(), t.wrench_in_end_effector = true; },
     "wrench.frame: got a value, expected no such key beside payload"},
    {"payload_of_no_work", [](TaskSpec& t) { t.payload.emplace(), t.c.setZero(), t.any.reset(); },
     "payload.com: got [0, 0, 0], expected a direction that does work"},
    {"payload_nan",
     [](TaskSpec& t) {
       t.payload.emplace().com.x() = kNan;
       t.c.setZero();
     },
     "payload.com: got [nan, 0, 0], expected a list of 3 finite numbers"},
    {"payload_cob_nan",
     [](TaskSpec& t) {
       t.payload.emplace().cob = Eigen::Vector3d(0, 0, kNan);
       t.c.setZero();
     },
     "payload.cob: got [0, 0, nan], expected a list of 3 finite numbers"},
    {"payload_without_gravity",
     [](TaskSpec& t) {
       t.payload.emplace();
       t.c.setZero();
       t.robot.gravity = 0;
     },
     "payload: got a wrench of 0 per kg, expected a payload with weight in water"},
    {"payload_as_light_as_water",
     [](TaskSpec& t) {
       t.payload.emplace().volume = 0.001;
       t.c.setZero();
       t.robot.water_density = 1000;
     },
     "payload: got a wrench of 0 per kg, expected a payload with weight in water"},
    {"in_time",
     [](TaskSpec& t) {
       t = push_on_the_way();
       t.uncertainty.emplace().trim = 0.1;
     },
     "uncertainty.trim: got a value, expected no such key except in static tasks; tasks in time "
     "have thrust and torque"},
    {"current_and_second_contact",
     [](TaskSpec& t) {
       t = push_on_wall();
       t.current = Eigen::Vector3d(0.3, 0, 0);
     },
     "environment.current: got [0.3, 0, 0], expected zero beside [contact]"},
    {"uncertain_current_and_second_contact",
     [](TaskSpec& t) {
       t = push_on_wall();
       t.uncertainty.emplace().current_speed = 0.3;
     },
     "uncertainty.current: got a value, expected no such key beside [contact]"},
    {"all_losses_of_many",
     [](TaskSpec& t) {
       for (int i = 0; i < 30; ++i) {
         t.robot.thrusters.push_back(t.robot.thrusters[0]);
         t.robot.thrusters.back().name = "thruster_" + std::to_string(i);
       }
       t.robot = finalize(t.robot);
       t.loss = LossSpec{.any = 20};
     },
     "loss.any: got 20, expected at most 100000 scenarios, not 1"},
    {"corners_of_many",
     [](TaskSpec& t) {
       t.robot.parts.clear();
       std::map<std::string, double> masses;
       for (int i = 0; i < 40; ++i) {
         const std::string name = "part_" + std::to_string(i);
         masses[name] = 0.1;
         t.robot.parts.push_back({.name = name, .link = 0, .frame = {}, .mass = 0.25});
       }
       for (int i : {1, 2}) {
         t.robot.parts.push_back({.name = t.robot.links[i].name,
                                  .link = i,
                                  .frame = {},
                                  .mass = 0.1,
                                  .com = {0.05, 0, 0}});
       }
       t.robot = finalize(t.robot);
       t.uncertainty.emplace().mass = masses;
     },
     "uncertainty: got 1.09951e+12 scenarios, expected at most 100000"},
    {"ends_of_many",
     [](TaskSpec& t) {
       for (int i = 0; i < 40; ++i) {
         t.robot.thrusters.push_back(t.robot.thrusters[0]);
         t.robot.thrusters.back().name = "thruster_" + std::to_string(i);
         t.robot.thrusters.back().force_min = 0.1;
       }
       t.robot = finalize(t.robot);
       t.uncertainty.emplace().thrust = 0.1;
     },
     "uncertainty.thrust: got 40 actuators whose limits exclude zero, expected at most 100000"},
};

class BadListInCode : public testing::TestWithParam<BadList> {};

TEST_P(BadListInCode, IsRejected) {
  TaskSpec task = push();
  GetParam().spoil(task);
  const std::string message = rejection_of([&] { make_problem(task); });
  EXPECT_THAT(message, HasSubstr(GetParam().message));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, BadListInCode, testing::ValuesIn(kBadLists),
                         [](const auto& test) { return std::string(test.param.name); });

/// A gear and its leader fail together, which no loss of one joint describes.
TEST(LossInCode, OfAGear) {
  Robot robot = vehicle();
  for (const char* name : {"finger", "thumb"}) {
    Joint joint = robot.joints[1];
    joint.name = name;
    joint.parent = 2;
    robot.joints.push_back(joint);
    robot.links.push_back({.name = std::string(name) + "_tip"});
  }
  robot.joints[3].gear = Gear{.leader = 2};
  TaskSpec task = push(finalize(robot));
  for (const char* name : {"finger", "thumb", "joints"}) {
    task.loss = LossSpec{.any = 1, .actuators = {name}};
    EXPECT_THAT(rejection_of([&] { make_problem(task); }),
                HasSubstr("'], expected actuators without a gear: a gear connects '"))
        << name;
  }
  task.loss->actuators = {"elbow"};
  EXPECT_EQ(make_problem(task).scenarios.limits.size(), 2u);
}

}  // namespace
}  // namespace maxwrench
