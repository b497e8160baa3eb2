#pragma once

#include <algorithm>
#include <string>

#include "maxwrench/explain.h"
#include "maxwrench/problem.h"
#include "maxwrench/task.h"

namespace maxwrench {

/// The same task with a limit of effort i in another place.
inline Problem with_limit(Problem task, Eigen::Index i, LimitSide side, double limit) {
  const Zonotope& set = task.robot.actuation;
  Eigen::VectorXd low = set.u_min, high = set.u_max;
  (side == LimitSide::kLower ? low : high)[i] = limit;
  task.robot.actuation = make_zonotope(set.B, low, high);
  return task;
}

/// The number of the actuator with this name: thrusters, then joints.
inline Eigen::Index actuator_named(const Robot& robot, const std::string& name) {
  Eigen::Index i = 0;
  for (const Thruster& thruster : robot.thrusters) {
    if (thruster.name == name) return i;
    ++i;
  }
  for (const Joint& joint : robot.joints) {
    if (joint.name == name) return i;
    ++i;
  }
  return -1;
}

/// Two prismatic joints, x and y, of 0.5 and 0.25 kg and 1 N each, that carry a point. The task
/// pushes along c.
inline TaskSpec cartesian_push(const Vector6d& c) {
  Robot robot;
  robot.name = "gantry";
  robot.links = {{.name = "bed", .mass = 1, .inertia = Eigen::Matrix3d::Identity()},
                 {.name = "bridge", .mass = 0.5, .inertia = Eigen::Matrix3d::Identity()},
                 {.name = "carriage", .mass = 0.25, .inertia = Eigen::Matrix3d::Identity()}};
  for (const int axis : {0, 1}) {
    Joint joint;
    joint.name = axis == 0 ? "along_x" : "along_y";
    joint.type = JointType::kPrismatic;
    joint.axis = Eigen::Vector3d::Unit(axis);
    joint.parent = axis;
    joint.q_min = -1;
    joint.q_max = 1;
    joint.velocity_max = joint.effort_max = 1;
    robot.joints.push_back(joint);
  }
  robot.end_effectors = {{.name = "tool", .link = 2, .placement = {}}};
  TaskSpec task{.name = "gantry push", .robot = finalize(robot), .end_effector = "tool"};
  task.posture.emplace();
  task.c = c;
  return task;
}

}  // namespace maxwrench
