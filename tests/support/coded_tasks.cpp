#include "tests/support/coded_tasks.h"

#include "maxwrench/load.h"

namespace maxwrench {

Pose<double> yaw_turn(double yaw) {
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
  task.pose = yaw_turn(0.17453292519943295);
  task.c = along(0);
  task.any = {"fx", "fy", "tz"};
  return task;
}

TaskSpec push() { return push(finalize(vehicle(), vehicle_shapes())); }

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

TaskSpec push_on_the_way() {
  TaskSpec task = push();
  MotionTask& motion = task.motion.emplace();
  motion.path = Path::screw(task.pose, Eigen::Vector3d::UnitZ(), task.pose.p, 1.5707963267948966,
                            Eigen::Vector3d::Zero(), Timing::kCubic, 10);
  motion.k = 8;
  return task;
}

TaskSpec valve() {
  static const Robot robot = load_robot(problems_folder() / "uvms/bluerov2_alpha5.toml");
  TaskSpec task{.name = "valve", .robot = robot, .end_effector = "tool"};
  task.c = along(5);
  return task;
}

std::vector<std::string> limit_names(const ScenarioList& list) {
  std::vector<std::string> names;
  for (const ScenarioLimits& each : list.limits) names.push_back(each.name);
  return names;
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

}  // namespace maxwrench
