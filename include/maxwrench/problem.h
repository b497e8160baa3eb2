#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/contact.h"
#include "maxwrench/path.h"
#include "maxwrench/robot.h"

namespace maxwrench {

class IkStartSystem;

/// What a static task leaves free of the end effector's pose: with X_0 = `Problem::pose` and the
/// coordinates s, those that are not free zero,
///
///     X(s) = X_0 Trans(x, y, z) Rz(yaw) Ry(pitch) Rx(roll)      along the axes of X_0,
///     X(s) = X_0 Rz(yaw) Ry(pitch) Rx(roll) Trans(x, y, z)      along the end effector's own.
///
/// So the end effector turns about its own origin, wherever that has moved to, or about that of
/// X_0, whose distance it keeps.
struct FreePose {
  std::vector<int> axes;  ///< of s, in increasing order: numbers of kTwistAxes [m; rad]
  bool along_end_effector = false;
  /// c and the other wrenches turn with the end effector, from where they are at X_0.
  bool wrench_turns = false;
  int count() const { return static_cast<int>(axes.size()); }
};

/// A robot and a task: hold the end effector at a pose, or move it along a path, and exert the
/// largest wrench along c.
struct Problem {
  std::string name;   ///< as on the command line, such as "planar/force"
  std::string label;  ///< how far the numbers are to be trusted, such as "identified"
  std::string source;
  /// Of all the bytes of the files that task and robot were read from, 16 hexadecimal digits of
  /// FNV-1a; empty if they were not read from files.
  std::string digest;
  Robot robot;
  int end_effector = 0;
  Pose<double> pose;  ///< of the end effector in the world; where a path starts
  FreePose free;      ///< how a static task lets it leave this pose
  Vector6d c;         ///< unit direction [force; torque] in world axes
  /// A task in time. A static problem has none.
  std::optional<MotionTask> motion;
  /// 6×k: the wrenches that `Wrench::kAny` allows, orthonormal; its span contains c, and each of
  /// its wrenches can do work.
  Matrix6Xd W_any;
  double reference = 1;  ///< N or N m along c, of measures of efforts at a given wrench
  /// What each axis of the wrench is measured by [N; N m], of measures of all axes at once, and the
  /// world axes of these axes at `pose`: the end effector's if the task gives wrenches in them.
  Vector6d desired = Vector6d::Ones();
  Eigen::Matrix3d wrench_axes = Eigen::Matrix3d::Identity();
  std::vector<int> redundant;  ///< the joints that theta_r holds
  /// The joints between base and end effector that theta_r does not hold. They follow from it as
  /// the base pose does (see lib/posture/ik/dependent_joints.h). None: the base pose follows in
  /// closed form.
  std::vector<int> dependent;
  /// A posture near one at theta_r_default, if there are dependent joints: all joints, and [x, y,
  /// z, yaw] of the base. A task in time begins on its IK solution; of a static one all IK
  /// solutions count.
  Eigen::VectorXd guess_q;
  Eigen::Vector4d guess_base = Eigen::Vector4d::Zero();
  /// What finds all IK solutions, shared by those that evaluate postures; null, or of another
  /// robot, task or limits: each of them makes its own, which takes some hundredths of a second.
  std::shared_ptr<const IkStartSystem> start_system;
  /// What a second end effector does, if there is one. Only the first is scored.
  std::optional<Contact> contact;
  /// theta_r: the joints that are free while the end effector keeps its pose, then the coordinates
  /// of that pose which are free, then the regrasp coordinates of the second contact.
  Eigen::VectorXd theta_r_min, theta_r_max, theta_r_default;

  /// Of a coordinate of theta_r: the joint, or pose_x, ..., pose_yaw, or regrasp_1, regrasp_2.
  std::string theta_r_name(int i) const;
  /// Its unit: "rad" or "m".
  const char* theta_r_unit(int i) const;
  int redundancy() const { return static_cast<int>(theta_r_min.size()); }
  /// Of the second contact's wrench, l; 0 without one.
  int contact_columns() const { return contact ? static_cast<int>(contact->C.cols()) : 0; }
  /// Of beta: "N" if c is a pure force, "N m" if a pure torque, "mixed" otherwise.
  const char* unit() const;
  /// "static", "trajectory" or "impulse".
  const char* type() const;
};

/// X(s) at theta_r.
Pose<double> pose_at(const Problem& problem, const Eigen::VectorXd& theta_r);

/// The same task with the end effector held at X(s), and c turned as it is there: nothing of its
/// pose is free, and theta_r has joints and regrasp coordinates only.
Problem held_at(const Problem& problem, const Eigen::VectorXd& theta_r);

/// Those coordinates of theta_r.
Eigen::VectorXd held_theta_r(const Problem& problem, const Eigen::VectorXd& theta_r);

/// Fills `start_system` of a problem with dependent joints.
void prepare_ik_solutions(Problem& problem);

}  // namespace maxwrench
