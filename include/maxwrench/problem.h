#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/contact.h"
#include "maxwrench/path.h"
#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

/// @file
/// A problem: a robot and a task.

namespace maxwrench {

class IkStartSystem;

/// The part of the end effector's pose that a static task leaves free.
///
/// Let X_0 be `Problem::pose` and s the coordinates, zero where they are not free. The pose is
///
///     X(s) = X_0 Trans(x, y, z) Rz(yaw) Ry(pitch) Rx(roll)      along the axes of X_0,
///     X(s) = X_0 Rz(yaw) Ry(pitch) Rx(roll) Trans(x, y, z)      along the end effector's own.
///
/// In the first case the end effector rotates about its own origin, wherever it has moved. In the
/// second case it rotates about the origin of X_0, at constant distance.
struct FreePose {
  std::vector<int> axes;  ///< the free coordinates, in increasing order: indices of kTwistAxes [m;
                          ///< rad]
  bool along_end_effector = false;  ///< true: the second case, along the end effector's own axes
  /// Whether c and the other wrenches turn with the end effector, from their directions at X_0.
  bool wrench_turns = false;
  /// Returns the number of free coordinates.
  int count() const { return static_cast<int>(axes.size()); }
};

/// A robot and a task: to hold the end effector at a pose, or move it along a path, and exert the
/// largest wrench along c.
///
/// `load_problem` and `make_problem` make problems.
struct Problem {
  std::string name;    ///< name as on the command line, such as "planar/force"
  std::string label;   ///< how reliable the numbers are, such as "identified"
  std::string source;  ///< where the numbers come from
  /// The FNV-1a hash, 16 hexadecimal digits, of all bytes of the files of task and robot. Empty if
  /// they were not read from files.
  std::string digest;
  Robot robot;           ///< the robot
  int end_effector = 0;  ///< index in `Robot::end_effectors`
  Pose<double> pose;     ///< pose of the end effector in the world; the start of a path
  FreePose free;         ///< the free part of the pose of a static task
  /// Unit direction [force; torque] in world axes. Of a payload or a table of wrenches in time it
  /// is that of the first wrench, for pictures.
  Vector6d c;
  /// The task in time. A static problem has none.
  std::optional<MotionTask> motion;
  /// Orthonormal basis of the wrenches that `Wrench::kAny` allows (6×k). Its span contains c, and
  /// each of its wrenches can do work.
  Matrix6Xd W_any;
  /// Wrench along c [N or N m], for measures of the efforts at a given wrench.
  double reference = 1;
  /// The unit of each axis of the wrench [N; N m], for measures of all axes together.
  Vector6d desired = Vector6d::Ones();
  /// World axes of the axes of `desired` at `pose`: those of the end effector if the task gives
  /// wrenches in them.
  Eigen::Matrix3d wrench_axes = Eigen::Matrix3d::Identity();
  /// Whether the task gives its wrenches in the axes of the end effector.
  bool wrench_in_end_effector = false;
  std::vector<int> redundant;  ///< the joints in theta_r
  /// The dependent joints: the joints between base and end effector that are not in theta_r.
  ///
  /// They follow from theta_r, as the pose of the base does (see
  /// lib/posture/ik/dependent_joints.h). If there are none, the pose of the base has a closed form.
  std::vector<int> dependent;
  /// Joints of a posture near one at theta_r_default, if there are dependent joints [rad or m].
  ///
  /// A task in time starts on the IK solution of the guess. For a static task all IK solutions
  /// count.
  Eigen::VectorXd guess_q;
  /// The base in the posture of `guess_q`: x, y, z, yaw [m; rad].
  Eigen::Vector4d guess_base = Eigen::Vector4d::Zero();
  /// Finds all IK solutions; shared by all evaluators of postures.
  ///
  /// If it is null, or belongs to another robot, task or other limits, each evaluator makes its
  /// own, which takes a few hundredths of a second.
  std::shared_ptr<const IkStartSystem> start_system;
  /// The scenarios of a static task; empty for one wrench of the nominal robot. c is then the
  /// direction of the first wrench.
  ScenarioList scenarios;
  /// The second contact, if there is one. The value is the wrench of the first contact only.
  std::optional<Contact> contact;
  /// Lower limits of theta_r (r).
  ///
  /// theta_r holds the joints that are free while the end effector keeps its pose, then the free
  /// coordinates of the pose, then the regrasp coordinates of the second contact.
  Eigen::VectorXd theta_r_min,
      theta_r_max,      ///< upper limits of theta_r (r)
      theta_r_default;  ///< default theta_r (r)

  /// Returns the name of coordinate i of theta_r: its joint, pose_x .. pose_yaw, regrasp_1 or
  /// regrasp_2.
  std::string theta_r_name(int i) const;
  /// Returns the unit of coordinate i of theta_r: "rad" or "m".
  const char* theta_r_unit(int i) const;
  /// Returns r, the number of coordinates of theta_r.
  int redundancy() const { return static_cast<int>(theta_r_min.size()); }
  /// Returns l, the number of columns of the second contact's wrench; 0 without a second contact.
  int contact_columns() const { return contact ? static_cast<int>(contact->C.cols()) : 0; }
  /// Returns the unit of beta: "N" if c is a pure force, "N m" if it is a pure torque, else
  /// "mixed". A list of scenarios has its own. A payload has "kg", a table of wrenches "-".
  const char* unit() const;
  /// Returns the unit of an acceleration along c: "m/s^2" if c is a pure force, "rad/s^2" if it is
  /// a pure torque, else "mixed".
  const char* acceleration_unit() const;
  /// Returns the type of the task: "static", "trajectory", "impulse" or "transfer".
  const char* type() const;
};

/// Returns the pose X(s) of the end effector at theta_r (r), in the world.
Pose<double> pose_at(const Problem& problem, const Eigen::VectorXd& theta_r);

/// Returns the same task with the pose of the end effector fixed at X(s).
///
/// c is turned as it is at X(s). No coordinate of the pose is free, and theta_r has joints and
/// regrasp coordinates only.
///
/// @param problem  the task
/// @param theta_r  the redundant coordinates (r), which determine s
Problem held_at(const Problem& problem, const Eigen::VectorXd& theta_r);

/// Returns the joints and regrasp coordinates of theta_r (r): the theta_r of `held_at`.
Eigen::VectorXd held_theta_r(const Problem& problem, const Eigen::VectorXd& theta_r);

/// Fills `Problem::start_system` of a problem with dependent joints.
void prepare_ik_solutions(Problem& problem);

}  // namespace maxwrench
