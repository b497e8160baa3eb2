#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <ostream>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

struct BadTask {
  const char* name;
  std::function<TaskSpec()> make;
  std::function<void(TaskSpec&)> spoil;
  const char* message;
};

void PrintTo(const BadTask& bad, std::ostream* out) { *out << bad.name; }

TaskSpec still() { return push(); }

const std::vector<BadTask> kBadTasks = {
    {"robot_not_final", still, [](TaskSpec& t) { t.robot = vehicle(); },
     "robot: got 'planar vehicle', which is not complete, expected a robot that finalize returned"},
    {"end_effector_unknown", still, [](TaskSpec& t) { t.end_effector = "hand"; },
     "end_effector: got 'hand', expected an end effector of the robot: tool"},
    {"pose_nan", still, [](TaskSpec& t) { t.pose.p.x() = kNan; }, "pose.xyz: got [nan, 0, 0]"},
    {"pose_no_rotation", still, [](TaskSpec& t) { t.pose.R(2, 2) = 2; }, "pose.rpy: got ["},
    {"c_zero", still, [](TaskSpec& t) { t.c.setZero(); },
     "wrench.c: got [0, 0, 0, 0, 0, 0], expected a direction of nonzero length"},
    {"c_nan", still, [](TaskSpec& t) { t.c[1] = kNan; },
     "wrench.c: got [1, nan, 0, 0, 0, 0], expected a list of 6 finite numbers"},
    {"c_of_no_work", still, [](TaskSpec& t) { t.any.reset(), t.c = along(2); },
     "wrench.c: got [0, 0, 1, 0, 0, 0], expected a direction that does work"},
    {"c_outside_any", still,
     [](TaskSpec& t) {
       t.any = {"fy", "tz"};
     },
     "wrench.c: got [1, 0, 0, 0, 0, 0], expected a direction within any = fy, tz"},
    {"any_unknown", still,
     [](TaskSpec& t) {
       t.any = {"fx", "mz"};
     },
     "wrench.any: got ['fx', 'mz'], expected some of fx, fy"},
    {"any_of_no_work", still,
     [](TaskSpec& t) {
       t.any = {"fx", "fz"};
     },
     "wrench.any: got ['fx', 'fz'], expected axes of which every wrench does work"},
    {"reference_zero", still, [](TaskSpec& t) { t.reference = 0; }, "wrench.reference: got 0"},
    {"desired_zero", still, [](TaskSpec& t) { t.desired = along(0); },
     "wrench.desired: got [1, 0, 0, 0, 0, 0], expected numbers > 0"},
    {"joints_not_the_chain", still, [](TaskSpec& t) { t.joints = {{"elbow"}}; },
     "theta_r.joints: got ['elbow'], expected all joints from the base"},
    {"default_short", still, [](TaskSpec& t) { t.theta_r_default = Eigen::VectorXd::Zero(1); },
     "theta_r.default: got [0], expected a list of 2 finite numbers"},
    {"default_nan", still, [](TaskSpec& t) { t.theta_r_default = Eigen::Vector2d(kNan, 0); },
     "theta_r.default: got [nan, 0], expected a list of 2 finite numbers"},
    {"default_beyond_limits", still, [](TaskSpec& t) { t.theta_r_default = Eigen::Vector2d(0, 2); },
     "theta_r.default: got [0, 2], expected elbow within -1.04"},
    {"guess_of_nothing", still,
     [](TaskSpec& t) {
       t.guess = {{"elbow", 1}};
     },
     "theta_r.guess: got a table, expected no such key: only the base pose is dependent"},
    {"free_unknown", still, [](TaskSpec& t) { t.free = {"yawn"}; },
     "pose.free: got ['yawn'], expected some of x, y, z"},
    {"free_without_range", still, [](TaskSpec& t) { t.free = {"x"}; },
     "pose.free: got ['x'], expected a range of x, too"},
    {"range_unknown", still,
     [](TaskSpec& t) {
       t.range = {{"u", {0, 1}}};
     },
     "pose.range.u: got"},
    {"range_nan", still,
     [](TaskSpec& t) {
       t.range = {{"x", {0, kNan}}};
     },
     "pose.range.x: got [0, nan], expected a list of 2 finite numbers"},
    {"range_inverted", still,
     [](TaskSpec& t) {
       t.range = {{"x", {1, 0}}};
     },
     "pose.range.x: got [1, 0], expected [min, max] with min < max"},
    {"range_of_no_motion", still,
     [](TaskSpec& t) {
       t.range = {{"z", {0, 1}}};
     },
     "pose.range.z: got [0, 1], expected axes along which the end effector can move (z is not "
     "one)"},
    {"contact_end_effector", push_on_wall, [](TaskSpec& t) { t.contact->end_effector = "tool"; },
     "contact.end_effector: got 'tool', expected an end effector with its own arm"},
    {"contact_forces", push_on_wall, [](TaskSpec& t) { t.contact->forces = "glue"; },
     "contact.forces: got 'glue', expected none, point, push"},
    {"contact_basis_beside_forces", push_on_wall, [](TaskSpec& t) { t.contact->forces = "push"; },
     "contact.basis: got 2 directions, expected no such key unless forces = 'basis'"},
    {"contact_mu", push_on_wall,
     [](TaskSpec& t) { t.contact->forces = "friction", t.contact->basis.clear(); },
     "contact.mu: got nothing, expected a finite number"},
    {"contact_mu_nan", push_on_wall,
     [](TaskSpec& t) { t.contact->forces = "friction", t.contact->mu = kNan; },
     "contact.mu: got nan, expected a finite number"},
    {"contact_direction_nan", push_on_wall,
     [](TaskSpec& t) { t.contact->basis[1].direction[2] = kNan; },
     "contact.basis[1].direction: got [-0.5, 0, nan, 0, 0, 0], expected a list of 6 finite"},
    {"contact_min_positive", push_on_wall, [](TaskSpec& t) { t.contact->basis[0].min = 1; },
     "contact.basis[0].min: got 1, expected a number <= 0"},
    {"contact_direction_of_no_work", push_on_wall,
     [](TaskSpec& t) { t.contact->basis[0].direction = along(1); },
     "contact.basis[0].direction: got [0, 1, 0, 0, 0, 0], expected one that does work"},
    {"contact_radius", push_on_wall, [](TaskSpec& t) { t.contact->radius = 0.1; },
     "contact.radius: got 0.1, expected no such key unless the shape is a circle"},
    {"contact_joints", push_on_wall, [](TaskSpec& t) { t.contact->joints = {"elbow"}; },
     "contact.joints: got ['elbow'], expected some of shoulder_2, elbow_2"},
    {"contact_rest", push_on_wall,
     [](TaskSpec& t) {
       t.contact->rest = {{"elbow_2", 0}};
     },
     "contact.rest.elbow_2: got an unknown key, expected one of"},
    {"contact_limits_crossed", push_on_wall, [](TaskSpec& t) { t.contact->max[0] = -0.2; },
     "contact.max: got [-0.2], expected numbers > min"},
    {"contact_default", push_on_wall, [](TaskSpec& t) { t.contact->initial[0] = 1; },
     "contact.default: got [1], expected numbers within min .. max"},
    {"contact_coordinates", push_on_wall, [](TaskSpec& t) { t.contact->min.resize(0); },
     "contact.min: got nothing, expected a list of 1 finite number"},
    {"contact_length_scale", push_on_wall, [](TaskSpec& t) { t.contact->length_scale = 0; },
     "contact.length_scale: got 0, expected a number > 0"},
    {"contact_in_time", push_on_the_way, [](TaskSpec& t) { t.contact = wall(); },
     "contact: got a table, expected none: only static tasks support a second contact"},
    {"free_in_time", push_on_the_way, [](TaskSpec& t) { t.free = {"yaw"}; },
     "pose.free: got ['yaw'], expected no such key except in static tasks"},
    {"T_tiny", push_on_the_way, [](TaskSpec& t) { t.motion->path = Path::constant(t.pose, 1e-9); },
     "motion.T: got 1e-09, expected a number from 0.001 to 1e+06, > 0"},
    {"path_elsewhere", push_on_the_way, [](TaskSpec& t) { t.pose.p.x() = 1; },
     "pose.xyz: got [1, 0, 0], expected the place and rotation at which the path starts, here"},
    {"path_infinite", push_on_the_way,
     [](TaskSpec& t) {
       t.motion->path = Path::screw(t.pose, {0, 0, 1}, {1e308, 1e308, 0}, 1e308, {1e308, 0, 0},
                                    Timing::kCubic, 10);
     },
     "path.xyz: got ["},
    {"k_zero", push_on_the_way, [](TaskSpec& t) { t.motion->k = 0; },
     "motion.k: got 0, expected a whole number from 1 to 1000"},
    {"k_one", push_on_the_way, [](TaskSpec& t) { t.motion->k = 1; },
     "motion.k: got 1, expected 2 or more for the scheme spline"},
    {"instants", push_on_the_way, [](TaskSpec& t) { t.motion->instants_per_interval = 0; },
     "motion.instants_per_interval: got 0, expected a whole number from 1 to 100"},
    {"scheme_of_a_impulse", push_on_the_way,
     [](TaskSpec& t) { t.motion->scheme = Scheme::kBackward; },
     "motion.scheme: got 'backward', expected one of forward, ends, spline"},
    {"t_h", impulse, [](TaskSpec& t) { t.motion->t_h = 5; },
     "motion.t_h: got 5, expected a knot from 1 to k = 4, or 'best'"},
    {"theta_0_short", impulse, [](TaskSpec& t) { t.motion->theta_0.resize(0); },
     "start.theta_r: got nothing, expected a list of 4 finite numbers"},
    {"default_of_a_impulse", impulse, [](TaskSpec& t) { t.theta_r_default = t.motion->theta_0; },
     "expected none: the default of an impulse is start.theta_r"},
    {"impulse_in_tool_axes", impulse, [](TaskSpec& t) { t.wrench_in_end_effector = true; },
     "wrench.frame: got 'end_effector', expected 'world'"},
};

class BadTaskInCode : public testing::TestWithParam<BadTask> {};

TEST_P(BadTaskInCode, IsRejected) {
  TaskSpec task = GetParam().make();
  GetParam().spoil(task);
  EXPECT_THAT(rejection_of([&] { make_problem(task); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(InCode, BadTaskInCode, testing::ValuesIn(kBadTasks),
                         [](const auto& test) { return std::string(test.param.name); });

/// What only tasks with dependent joints can get wrong.
TEST(InCode, SLOW_JointsThatFollowWrongly) {
  TaskSpec task{.robot = load_robot(problems_folder() / "mobile/rover.toml"),
                .end_effector = "tool"};
  task.pose.p = {0, 0, 2.9};
  task.c = along(0);
  const auto message = [&] { return rejection_of([&] { make_problem(task); }); };
  EXPECT_THAT(message(), HasSubstr("pose.xyz: got [0, 0, 2.9], expected a pose that"));
  task.joints = {"elbow", "wrist_roll"};
  EXPECT_THAT(message(), HasSubstr("in no posture: singular"));
  task.joints = {"shoulder_yaw", "shoulder_pitch"};
  EXPECT_THAT(message(), HasSubstr("pose.xyz: got [0, 0, 2.9], expected a pose that elbow"));
  task.guess = {{"elbw", 1}};
  EXPECT_THAT(message(),
              HasSubstr("theta_r.guess.elbw: got an unknown key, expected one of elbow"));
  task.guess = {{"elbow", 4}};
  EXPECT_THAT(message(), HasSubstr("theta_r.guess.elbow: got 4, expected a number within -2.6"));
  task.guess = {{"elbow", 1}};
  task.guess_base = {{"z", 1}};
  EXPECT_THAT(message(),
              HasSubstr("theta_r.guess_base.z: got an unknown key, expected one of x, y"));
  task.guess_base = {{"x", kNan}};
  EXPECT_THAT(message(), HasSubstr("theta_r.guess_base.x: got nan, expected a finite number"));
}

/// A default at which a joint does not reach, and a second contact whose joints it leaves free.
TEST(InCode, ImpossibleDefaultAndRank) {
  TaskSpec task{.robot = load_robot(problems_folder() / "mobile/rover.toml"),
                .end_effector = "tool"};
  task.pose.p = {0, 0, 0.9};
  task.c = along(0);
  task.joints = {"shoulder_yaw", "shoulder_pitch"};
  task.theta_r_default = Eigen::Vector2d(0, 1.9);
  EXPECT_THAT(rejection_of([&] { make_problem(task); }),
              HasSubstr("theta_r.default: got [0, 1.9], expected theta_r at which elbow"));
  TaskSpec bar{.robot = load_robot(problems_folder() / "dual_arm/bar.toml"),
               .end_effector = "bar_end"};
  bar.c = along(5);
  bar.contact = {.end_effector = "right_tool", .forces = "point"};
  bar.contact->frame.p = {-0.2, -0.5, 0};
  bar.contact->joints = {"right_q2_shoulder_pitch", "right_q3_elbow", "right_q4_wrist_roll"};
  EXPECT_THAT(rejection_of([&] { make_problem(bar); }),
              HasSubstr("expected joints that the contact determines: of these 3 it determines 2"));
}

}  // namespace
}  // namespace maxwrench
