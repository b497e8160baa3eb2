#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <ostream>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/task.h"

// Robots and tasks that are built in code, beside those of the files that say the same.

namespace maxwrench {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Pose<double> turned(double yaw) {
  return {Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          Eigen::Vector3d::Zero()};
}

Vector6d along(int axis) { return Vector6d::Unit(axis); }

/// A capsule from the link's origin to (0.1, 0, 0): its axis, z, along the link's x.
Shape capsule(int link) {
  Shape shape{.link = link, .radius = 0.01, .half_length = 0.05};
  shape.placement.R << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  shape.placement.p = {0.05, 0, 0};
  return shape;
}

/// problems/planar/vehicle.toml and .urdf, number by number.
Robot vehicle() {
  Robot robot;
  robot.name = "planar vehicle";
  robot.base_axes = {5, 0, 1};
  const Eigen::Matrix3d hull = Eigen::Vector3d(0.15, 0.32, 0.43333).asDiagonal();
  const Eigen::Matrix3d rod = Eigen::Vector3d(5e-6, 8.75e-5, 8.75e-5).asDiagonal();
  robot.links = {{.name = "hull", .mass = 10, .inertia = hull},
                 {.name = "link_1", .mass = 0.1, .com = {0.05, 0, 0}, .inertia = rod},
                 {.name = "link_2", .mass = 0.1, .com = {0.05, 0, 0}, .inertia = rod}};
  const double limit = 1.0471975511965976;
  for (const char* name : {"shoulder", "elbow"}) {
    Joint joint;
    joint.name = name;
    joint.q_min = -limit;
    joint.q_max = limit;
    joint.velocity_max = joint.effort_max = 1;
    joint.axis = {0, 0, 1};
    joint.parent = static_cast<int>(robot.joints.size());
    joint.placement.p =
        joint.parent == 0 ? Eigen::Vector3d(0.3, 0.1, 0) : Eigen::Vector3d(0.1, 0, 0);
    robot.joints.push_back(joint);
  }
  robot.thrusters = {{"front_left", {0.3, 0.2, 0}, {4, -1, 0}, -1, 1},
                     {"front_right", {0.3, -0.2, 0}, {4, 1, 0}, -1, 1},
                     {"rear_left", {-0.3, 0.2, 0}, {4, 1, 0}, -1, 1},
                     {"rear_right", {-0.3, -0.2, 0}, {4, -1, 0}, -1, 1}};
  robot.end_effectors = {{.name = "tool", .link = 2, .placement = {.p = {0.1, 0, 0}}}};
  return robot;
}

Collision vehicle_shapes() {
  Collision collision;
  collision.shapes = {
      {.link = 0, .kind = Shape::Kind::kBox, .half_sizes = Eigen::Vector3d(0.3, 0.2, 0.1)},
      capsule(1),
      capsule(2)};
  collision.ignore = {{"hull", "link_1"}, {"link_1", "link_2"}};
  collision.margin = 0.005;
  return collision;
}

/// problems/planar/force.toml.
TaskSpec push(const Robot& robot) {
  TaskSpec task{.name = "push", .robot = robot, .end_effector = "tool"};
  task.pose = turned(0.17453292519943295);
  task.c = along(0);
  task.any = {"fx", "fy", "tz"};
  return task;
}

TaskSpec push() { return push(finalize(vehicle(), vehicle_shapes())); }

/// The two problems have equal values and gradients, for both kinds of wrench, at their default and
/// near it.
void expect_same(const Problem& coded, const Problem& loaded) {
  ASSERT_EQ(coded.redundancy(), loaded.redundancy());
  EXPECT_EQ(coded.theta_r_min, loaded.theta_r_min);
  EXPECT_EQ(coded.theta_r_max, loaded.theta_r_max);
  EXPECT_EQ(coded.theta_r_default, loaded.theta_r_default);
  EXPECT_EQ(coded.dependent, loaded.dependent);
  EXPECT_EQ(coded.guess_q, loaded.guess_q);
  EXPECT_EQ(coded.W_any, loaded.W_any);
  EXPECT_EQ(coded.digest, "");
  for (const double step : {0.0, 0.01, 0.02}) {
    const Eigen::VectorXd theta_r =
        loaded.theta_r_default + step * (loaded.theta_r_max - loaded.theta_r_default);
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      Options options;
      options.wrench = wrench;
      const Answer a = evaluate(coded, theta_r.transpose(), options);
      const Answer b = evaluate(loaded, theta_r.transpose(), options);
      ASSERT_EQ(a.status, b.status) << a.reason.c_str() << b.reason.c_str();
      EXPECT_EQ(a.status, Status::kOptimal);
      EXPECT_EQ(a.beta(), b.beta());
      EXPECT_EQ(a.trajectory.gradient, b.trajectory.gradient);
    }
  }
}

TEST(InCode, RobotAndTaskAreThoseOfTheFile) {
  Problem loaded = load_problem("planar/force");
  const Problem coded = make_problem(push());
  EXPECT_EQ(coded.robot.actuation.B, loaded.robot.actuation.B);
  EXPECT_EQ(coded.robot.u_rate_max, loaded.robot.u_rate_max);
  ASSERT_EQ(coded.robot.collision->pairs(), 1);
  EXPECT_EQ(coded.robot.collision->pair_name(0), loaded.robot.collision->pair_name(0));
  EXPECT_EQ(coded.robot.convex_bodies.size(), 3u);
  expect_same(coded, loaded);
}

/// With wider limits, so that the arm can fold into the hull.
TEST(InCode, ShapesCollideAsThoseOfTheFile) {
  Robot robot = vehicle();
  for (Joint& joint : robot.joints) joint.q_min = -3, joint.q_max = 3;
  const Problem problem = make_problem(push(finalize(robot, vehicle_shapes())));
  const Eigen::RowVector2d folded(3, 0);  // link_2 is inside the hull
  EXPECT_EQ(evaluate(problem, folded).status, Status::kInvalidPosture);
  EXPECT_THAT(std::string(evaluate(problem, folded).reason.c_str()), HasSubstr("link_2"));
  const Problem without = make_problem(push(finalize(robot)));
  EXPECT_EQ(without.robot.collision, nullptr);
  EXPECT_EQ(evaluate(without, folded).status, Status::kOptimal);
}

/// The file turns by roll, pitch and yaw, one after the other, which leaves another rounding.
TEST(InCode, JointsThatFollow) {
  const Problem loaded = load_problem("mobile/push");
  TaskSpec task{.robot = load_robot(problems_folder() / "mobile/rover.toml"),
                .end_effector = "tool"};
  task.pose = turned(0.7);
  task.pose.p = {0, 0, 0.9};
  EXPECT_LT((task.pose.R - loaded.pose.R).norm(), 1e-15);
  task.pose.R = loaded.pose.R;
  task.c = along(0);
  task.joints = {"shoulder_yaw", "shoulder_pitch"};
  task.theta_r_default = Eigen::Vector2d(0, -1);
  task.guess = {{"elbow", 1}, {"wrist_pitch", 0}, {"wrist_roll", 0}};
  expect_same(make_problem(task), loaded);
}

TEST(InCode, FreePose) {
  const Problem loaded = load_problem("mobile/push_any_height");
  TaskSpec task{.robot = loaded.robot, .end_effector = "tool"};
  task.pose = loaded.pose;
  task.c = loaded.c;
  task.joints = {"shoulder_yaw", "shoulder_pitch"};
  for (int i = 0; i < loaded.free.count(); ++i) {
    const auto at = static_cast<Eigen::Index>(loaded.redundant.size()) + i;
    const auto axis = static_cast<std::size_t>(loaded.free.axes[static_cast<std::size_t>(i)]);
    task.range[kTwistAxes[axis]] = {loaded.theta_r_min[at], loaded.theta_r_max[at]};
  }
  const Problem coded = make_problem(task);
  EXPECT_EQ(coded.free.axes, loaded.free.axes);
  EXPECT_EQ(coded.theta_r_max.tail(1), loaded.theta_r_max.tail(1));
  const Eigen::MatrixXd theta_r = loaded.theta_r_default.transpose();
  EXPECT_EQ(evaluate(coded, theta_r).beta(), evaluate(loaded, theta_r).beta());
}

/// planar/two_arms: a finger with friction on a wall, whose x is the world's y and whose z is x.
ContactSpec wall() {
  ContactSpec contact{.end_effector = "second_tool", .forces = "basis"};
  contact.surface = Surface::kLine;
  contact.frame.p = {-0.02, -0.25, 0};
  contact.frame.R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  contact.basis.resize(2);
  contact.basis[0] = {.direction = 0.5 * along(0) + along(2), .min = 0};
  contact.basis[1] = {.direction = -0.5 * along(0) + along(2), .min = 0};
  contact.min = Eigen::VectorXd::Constant(1, -0.12);
  contact.max = Eigen::VectorXd::Constant(1, 0.12);
  contact.initial = Eigen::VectorXd::Zero(1);
  contact.joints = {"shoulder_2", "elbow_2"};
  contact.length_scale = 0.1;
  return contact;
}

TaskSpec push_on_wall() {
  TaskSpec task = push(load_robot(problems_folder() / "planar/two_arms_robot.toml"));
  task.contact = wall();
  return task;
}

/// The file turns the frame by roll and yaw of 90 degrees, which leaves a rounding of 6e-17.
TEST(InCode, SecondContact) {
  const Problem loaded = load_problem("planar/two_arms");
  TaskSpec task = push_on_wall();
  EXPECT_LT((task.contact->frame.R - loaded.contact->frame.R).norm(), 1e-15);
  task.contact->frame.R = loaded.contact->frame.R;
  const Problem coded = make_problem(task);
  ASSERT_TRUE(coded.contact.has_value());
  EXPECT_EQ(coded.contact->C, loaded.contact->C);
  EXPECT_EQ(coded.contact->w_min, loaded.contact->w_min);
  EXPECT_EQ(coded.contact->rank, loaded.contact->rank);
  EXPECT_EQ(coded.contact->follow, loaded.contact->follow);
  expect_same(coded, loaded);
}

TaskSpec push_on_the_way() {
  TaskSpec task = push();
  MotionTask& motion = task.motion.emplace();
  motion.path = Path::screw(task.pose, Eigen::Vector3d::UnitZ(), task.pose.p, 1.5707963267948966,
                            Eigen::Vector3d::Zero(), Timing::kCubic, 10);
  motion.k = 8;
  return task;
}

TEST(InCode, OdeSolution) {
  const Problem coded = make_problem(push_on_the_way());
  EXPECT_EQ(coded.motion->T, 10);
  expect_same(coded, load_problem("planar/trajectory"));
}

TaskSpec impulse() {
  const Problem loaded = load_problem("uvms/valve_impulse");
  TaskSpec task{.robot = loaded.robot, .end_effector = "tool"};
  task.c = along(5);
  MotionTask& motion = task.motion.emplace();
  motion.impulse = true;
  motion.T = 2.5;
  motion.k = 4;
  motion.t_h = 3;
  motion.instants_per_interval = 16;
  motion.theta_0 = Eigen::Vector4d(3.064281330005719, 0.689460959319073, 0.42879604745107663,
                                   -3.0277900989486017);
  return task;
}

TEST(InCode, Impulse) {
  const Problem coded = make_problem(impulse()), loaded = load_problem("uvms/valve_impulse");
  const Eigen::MatrixXd theta_r = coded.theta_r_default.transpose();
  const Answer a = evaluate(coded, theta_r), b = evaluate(loaded, theta_r);
  EXPECT_EQ(a.status, Status::kOptimal);
  EXPECT_EQ(a.beta(), b.beta());
  EXPECT_EQ(a.trajectory.gradient, b.trajectory.gradient);
}

/// Directions have any length; what was derived before counts for nothing.
TEST(InCode, FinalizeDerivesAnew) {
  const Robot robot = finalize(vehicle(), vehicle_shapes());
  Robot weaker = robot;
  weaker.thrusters[0].direction *= 7;
  weaker.thrusters[0].force_max = 0.5;
  weaker = finalize(weaker);
  EXPECT_EQ(weaker.collision, nullptr);
  EXPECT_TRUE(weaker.convex_bodies.empty());
  EXPECT_EQ(weaker.actuation.u_max[0], 0.5);
  EXPECT_LT((weaker.actuation.B - robot.actuation.B).norm(), 1e-15);
}

template <class Function>
std::string rejection(const Function& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

struct BadRobot {
  const char* name;
  std::function<void(Robot&, Collision&)> spoil;
  const char* message;
};

void PrintTo(const BadRobot& bad, std::ostream* out) { *out << bad.name; }

const std::vector<BadRobot> kBadRobots = {
    {"axes",
     [](Robot& r, Collision&) {
       r.base_axes = {1, 5};
     },
     "base.axes: got ['y', 'yaw'], expected one of [], [x]"},
    {"axis_unknown",
     [](Robot& r, Collision&) {
       r.base_axes = {0, 1, 7};
     },
     "base.axes: got ['x', 'y', 7], expected one of"},
    {"mount_no_rotation", [](Robot& r, Collision&) { r.mount.R *= 2; }, "base.rpy: got [2, 0, 0"},
    {"mount_reflected", [](Robot& r, Collision&) { r.mount.R *= -1; }, "base.rpy: got [-1, "},
    {"mount_nan", [](Robot& r, Collision&) { r.mount.p.x() = kNan; },
     "base.xyz: got [nan, 0, 0], expected a list of 3 finite numbers"},
    {"links_missing", [](Robot& r, Collision&) { r.links.pop_back(); },
     "link: got 2 links, expected 3: the base, and one for each joint"},
    {"link_twice", [](Robot& r, Collision&) { r.links[2].name = "hull"; },
     "link[hull]: got a duplicate name, expected unique names"},
    {"link_without_name", [](Robot& r, Collision&) { r.links[2].name = ""; },
     "link.name: got '', expected a name"},
    {"mass_nan", [](Robot& r, Collision&) { r.links[1].mass = kNan; },
     "link[link_1].inertial.mass: got nan, expected a mass >= 0"},
    {"mass_infinite", [](Robot& r, Collision&) { r.links[1].mass = kInfinity; },
     "link[link_1].inertial.mass: got inf, expected a mass >= 0"},
    {"mass_negative", [](Robot& r, Collision&) { r.links[1].mass = -1; },
     "link[link_1].inertial.mass: got -1, expected a mass >= 0"},
    {"inertia_nan", [](Robot& r, Collision&) { r.links[1].inertia(0, 0) = kNan; },
     "link[link_1].inertial.inertia: got [nan, "},
    {"inertia_skew", [](Robot& r, Collision&) { r.links[1].inertia(0, 1) = 1e-6; },
     "9 finite numbers of a symmetric matrix"},
    {"com_nan", [](Robot& r, Collision&) { r.links[1].com.z() = kNan; },
     "link[link_1].inertial.origin.xyz: got [0.05, 0, nan], expected a list of 3 finite numbers"},
    {"volume_negative", [](Robot& r, Collision&) { r.links[0].volume = -1; },
     "buoyancy.hull.volume: got -1, expected a number >= 0"},
    {"added_mass_negative",
     [](Robot& r, Collision&) {
       r.links[0].hydrodynamics.resize(1);
       r.links[0].hydrodynamics[0].added_mass[2] = -1;
     },
     "hydrodynamics.hull.added_mass: got [0, 0, -1, 0, 0, 0], expected 6 numbers >= 0"},
    {"drag_in_air", [](Robot& r, Collision&) { r.links[0].hydrodynamics.resize(1); },
     "environment.water_density: got 0, expected a density > 0: 'hull' has added mass"},
    {"added_mass_of_one_link_only",
     [](Robot& r, Collision&) {
       r.water_density = 1000;
       r.links[0].hydrodynamics.resize(1);
       r.links[1].volume = 0.001;
     },
     "hydrodynamics.link_1: got nothing, expected added mass and drag, perhaps zeros"},
    {"joint_twice", [](Robot& r, Collision&) { r.joints[1].name = "shoulder"; },
     "joint[shoulder]: got a duplicate name"},
    {"parent_of_itself", [](Robot& r, Collision&) { r.joints[1].parent = 2; },
     "joint[elbow].parent: got 2, expected an earlier link than the joint's own, which is 2"},
    {"parent_negative", [](Robot& r, Collision&) { r.joints[0].parent = -1; },
     "joint[shoulder].parent: got -1, expected an earlier link"},
    {"joint_axis_zero", [](Robot& r, Collision&) { r.joints[0].axis.setZero(); },
     "joint[shoulder].axis.xyz: got [0, 0, 0], expected a direction of nonzero length"},
    {"joint_frame", [](Robot& r, Collision&) { r.joints[0].placement.R(0, 0) = 2; },
     "joint[shoulder].origin.rpy: got [2, "},
    {"limits_crossed", [](Robot& r, Collision&) { r.joints[0].q_min = 2; },
     "joint[shoulder].limit.lower: got 2, expected at most upper = 1.04"},
    {"limits_missing", [](Robot& r, Collision&) { r.joints[0].q_max = kInfinity; },
     "joint[shoulder].limit.upper: got inf, expected a finite number"},
    {"effort_negative", [](Robot& r, Collision&) { r.joints[0].effort_max = -1; },
     "joint[shoulder].limit.effort: got -1, expected a number >= 0"},
    {"velocity_zero", [](Robot& r, Collision&) { r.joints[0].velocity_max = 0; },
     "joint[shoulder].limit.velocity: got 0, expected a number > 0"},
    {"thruster_as_joint", [](Robot& r, Collision&) { r.thrusters[1].name = "elbow"; },
     "thrusters.list[1].name: got 'elbow', expected a unique name"},
    {"thruster_without_direction", [](Robot& r, Collision&) { r.thrusters[0].direction.setZero(); },
     "thrusters.list[0].direction: got [0, 0, 0], expected a direction of nonzero length"},
    {"thruster_position_nan", [](Robot& r, Collision&) { r.thrusters[0].position.y() = kNan; },
     "thrusters.list[0].position: got [0.3, nan, 0], expected a list of 3 finite numbers"},
    {"thruster_limits_crossed", [](Robot& r, Collision&) { r.thrusters[2].force_max = -5; },
     "thrusters.list[2].force_max: got -5, expected at least force_min = -1"},
    {"thruster_limit_infinite", [](Robot& r, Collision&) { r.thrusters[2].force_max = kInfinity; },
     "thrusters.list[2].force_max: got inf, expected a finite number"},
    {"thruster_rate_zero", [](Robot& r, Collision&) { r.thrusters[2].force_rate_max = 0; },
     "thrusters.list[2].force_rate_max: got 0, expected a number > 0"},
    {"end_effector_link", [](Robot& r, Collision&) { r.end_effectors[0].link = 3; },
     "end_effectors.tool.link: got 3, expected a link: 0 to 2"},
    {"gravity_negative", [](Robot& r, Collision&) { r.gravity = -9.81; },
     "environment.gravity: got -9.81, expected a number >= 0"},
    {"trim_nan", [](Robot& r, Collision&) { r.trim.buoyancy_mass = kNan; },
     "trim.buoyancy_mass: got nan, expected a finite number"},
    {"shape_link", [](Robot&, Collision& c) { c.shapes[0].link = 3; },
     "collision.link: got 3, expected a link: 0 to 2"},
    {"shape_flat", [](Robot&, Collision& c) { c.shapes[0].half_sizes.z() = 0; },
     "link[hull].collision.geometry.box.size: got 0, expected a length > 0"},
    {"shape_thin", [](Robot&, Collision& c) { c.shapes[1].radius = 0; },
     "link[link_1].collision.geometry.capsule.radius: got 0, expected a length > 0"},
    {"shape_nan", [](Robot&, Collision& c) { c.shapes[1].half_length = kNan; },
     "link[link_1].collision.geometry.capsule.length: got nan, expected a finite number"},
    {"ignore_unknown", [](Robot&, Collision& c) { c.ignore[0].first = "arm"; },
     "collision.ignore: got 'arm', expected a link: hull, link_1, link_2"},
    {"margin_negative", [](Robot&, Collision& c) { c.margin = -1; },
     "collision.margin: got -1, expected a number >= 0"},
};

class BadRobotInCode : public testing::TestWithParam<BadRobot> {};

TEST_P(BadRobotInCode, IsRejected) {
  Robot robot = vehicle();
  Collision collision = vehicle_shapes();
  GetParam().spoil(robot, collision);
  EXPECT_THAT(rejection([&] { finalize(robot, collision); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(InCode, BadRobotInCode, testing::ValuesIn(kBadRobots),
                         [](const auto& test) { return std::string(test.param.name); });

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
  EXPECT_THAT(rejection([&] { make_problem(task); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(InCode, BadTaskInCode, testing::ValuesIn(kBadTasks),
                         [](const auto& test) { return std::string(test.param.name); });

/// What only tasks with dependent joints can get wrong.
TEST(InCode, SLOW_JointsThatFollowWrongly) {
  TaskSpec task{.robot = load_robot(problems_folder() / "mobile/rover.toml"),
                .end_effector = "tool"};
  task.pose.p = {0, 0, 2.9};
  task.c = along(0);
  const auto message = [&] { return rejection([&] { make_problem(task); }); };
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
  EXPECT_THAT(rejection([&] { make_problem(task); }),
              HasSubstr("theta_r.default: got [0, 1.9], expected theta_r at which elbow"));
  TaskSpec bar{.robot = load_robot(problems_folder() / "dual_arm/bar.toml"),
               .end_effector = "bar_end"};
  bar.c = along(5);
  bar.contact = {.end_effector = "right_tool", .forces = "point"};
  bar.contact->frame.p = {-0.2, -0.5, 0};
  bar.contact->joints = {"right_q2_shoulder_pitch", "right_q3_elbow", "right_q4_wrist_roll"};
  EXPECT_THAT(rejection([&] { make_problem(bar); }),
              HasSubstr("expected joints that the contact determines: of these 3 it determines 2"));
}

}  // namespace
}  // namespace maxwrench
