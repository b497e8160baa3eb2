#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/problem.h"

// Robots and tasks that are built in code. Files are read into the same structures, so the checks
// and their messages are the same: one line that names the key as it is called in files, the value
// and what was expected. docs/own_robot.md describes the keys.

namespace maxwrench {

/// A collision shape, fixed to a link of the robot.
struct Shape {
  enum class Kind { kCapsule, kBox, kCylinder };
  std::string body = "";  ///< what messages and `Collision::ignore` call it; empty: as its link
  int link = 0;
  Kind kind = Kind::kCapsule;
  /// Link -> shape. The shape is centred at its origin; the axis of capsule and cylinder is z.
  Pose<double> placement = {};
  double radius = 0;       ///< m, capsule and cylinder
  double half_length = 0;  ///< m, of the axis; a capsule of half length 0 is a sphere
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero();  ///< m, box
};

/// A posture collides if two shapes on different links are closer than `margin`, except for pairs
/// of bodies in `ignore`.
struct Collision {
  std::vector<Shape> shapes = {};
  std::vector<std::pair<std::string, std::string>> ignore = {};
  double margin = 0;  ///< m
};

/// Checks a robot and derives what follows from it: `actuation`, `u_rate_max`, `collision` and
/// `convex_bodies`, whatever they were. The caller fills the other members; directions and axes may
/// have any length but zero. Throws std::invalid_argument.
Robot finalize(Robot robot, const Collision& collision = {});

/// What a second end effector does (the table `[contact]` of a file).
struct ContactSpec {
  struct Direction {
    Vector6d direction = Vector6d::Zero();  ///< [force; torque] in contact axes
    double min = -kInfinity, max = kInfinity;
  };
  std::string end_effector = "";
  /// What the robot may exert: "none", "point" (any force), "push" (along +z), "friction" (a
  /// pyramid in the cone about +z), "grasp" (any wrench) or "basis".
  std::string forces = "";
  std::optional<double> mu = {};      ///< of friction
  std::vector<Direction> basis = {};  ///< of "basis"
  Surface surface = Surface::kPoint;
  Pose<double> frame = {};            ///< in the world, its z axis into the environment
  std::optional<double> radius = {};  ///< m, of a circle
  /// Of the regrasp coordinates [m; rad of a circle]; empty for a point.
  Eigen::VectorXd min = {}, max = {}, initial = {};
  std::vector<std::string> joints = {};  ///< that follow from the contact, in the order of the arm
  std::map<std::string, double> rest = {};  ///< where others of the arm rest [rad or m]; else 0
  double length_scale = Contact().length_scale;  ///< m
  double sigma_min = Contact().sigma_min;
};

/// What a user says of a task; everything else in a `Problem` follows from it.
struct TaskSpec {
  std::string name = "", label = "", source = "";  ///< free text
  Robot robot = {};                                ///< as `finalize` returns it
  std::string end_effector = "";
  /// Of the end effector in the world; along a path, where it starts.
  Pose<double> pose = {};
  /// Coordinates of the pose that a static task leaves free, by their names in kTwistAxes, and
  /// their limits [m; rad]: [min, max]. A translation needs limits; a coordinate that has them is
  /// free. Along the end effector's own axes, or those of `pose`.
  std::vector<std::string> free = {};
  std::map<std::string, std::array<double, 2>> range = {};
  bool along_end_effector = false;
  Vector6d c = Vector6d::Zero();  ///< [force; torque], of any length but zero
  /// c, `any` and `desired` are in the axes of the end effector and turn with it; else the world's.
  bool wrench_in_end_effector = false;
  /// What wrenches `Wrench::kAny` allows, by names in kWrenchAxes; none: all that do work.
  std::optional<std::vector<std::string>> any = {};
  double reference = 1;                     ///< as in `Problem`
  std::optional<Vector6d> desired = {};     ///< as in `Problem`
  std::optional<ContactSpec> contact = {};  ///< of static tasks
  /// Of a task in time. T follows from the path; an impulse gives T and its path is constant.
  /// c_turns follows from `wrench_in_end_effector`.
  std::optional<MotionTask> motion = {};
  /// The redundant joints, where others than the base follow; else all of the chain.
  std::optional<std::vector<std::string>> joints = {};
  /// Of the redundant joints [rad or m]; empty: zero within the limits, or where the pose is
  /// reached. Of an impulse it is `MotionTask::theta_0`.
  Eigen::VectorXd theta_r_default = {};
  /// A posture near one at the default, which names the IK solution: dependent joints by name, and
  /// free base axes by theirs. Empty: an IK solution is found.
  std::map<std::string, double> guess = {}, guess_base = {};
};

/// Checks a task and derives the rest: dependent joints and their IK solutions, the limits of
/// theta_r and a default, W_any, the contact's basis and rank. Throws std::invalid_argument.
Problem make_problem(const TaskSpec& spec);

}  // namespace maxwrench
