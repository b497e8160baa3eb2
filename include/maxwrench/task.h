#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/problem.h"

/// @file
/// Makes robots and tasks in code.
///
/// Files are read into the same structures, so the checks and their messages are the same: one line
/// that names the key as in files, the value and what was expected. docs/robot_files.md describes
/// the keys.

namespace maxwrench {

/// A collision shape, fixed to a link of the robot.
struct Shape {
  /// The kind of shape.
  enum class Kind {
    kCapsule,   ///< all points within `radius` of a segment of the z axis
    kBox,       ///< a box along the axes
    kCylinder,  ///< a cylinder about the z axis
    kHull       ///< all points within `radius` of the convex hull of `points`
  };
  /// Its name in messages and in `Collision::ignore`. Empty: the name of its link.
  std::string body = "";
  int link = 0;                ///< the link that carries it
  Kind kind = Kind::kCapsule;  ///< the kind of shape
  /// Link -> shape. The shape is centred at the origin of this frame.
  Pose<double> placement = {};
  double radius = 0;  ///< radius of capsule and cylinder; what a hull is grown by [m]
  /// Half of the length of the axis [m]; a capsule of half length 0 is a sphere.
  double half_length = 0;
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero();  ///< half of the sizes of the box [m]
  std::vector<Eigen::Vector3d> points = {};              ///< vertices of a hull, four or more [m]
};

/// The self-collision check of a robot.
///
/// A posture collides if two shapes on different links are closer than `margin`, except for pairs
/// of bodies in `ignore`.
struct Collision {
  std::vector<Shape> shapes = {};                                ///< the shapes
  std::vector<std::pair<std::string, std::string>> ignore = {};  ///< pairs of bodies by name
  double margin = 0;                                             ///< least distance [m]
  /// Leaves out more pairs: links that a joint connects, links that touch in the default posture
  /// (each joint at zero or at the limit nearest to zero) and links that touch in every one of 200
  /// random postures. `Robot::notes` then names them.
  bool find_ignored = false;
};

/// Checks a robot and computes its derived members.
///
/// These are `actuation`, `u_rate_max`, `collision` and `convex_bodies`; their earlier values are
/// overwritten. The caller fills all other members. Directions and axes may have any nonzero
/// length.
///
/// @param robot      the robot
/// @param collision  its collision shapes
/// @return the complete robot
/// @throws std::invalid_argument if a value is wrong.
Robot finalize(Robot robot, const Collision& collision = {});

/// The description of a second contact, the table `[contact]` of a file.
struct ContactSpec {
  /// A column of the basis of the contact wrenches, with its limits.
  struct Direction {
    Vector6d direction = Vector6d::Zero();  ///< direction [force; torque] in contact axes
    double min = -kInfinity,                ///< lower limit of its coordinate, at most 0
        max = kInfinity;                    ///< upper limit of its coordinate, at least 0
  };
  std::string end_effector = "";  ///< the name of the second end effector
  /// What the robot may exert: "none", "point" (any force), "push" (along +z), "friction" (a
  /// pyramid in the cone about +z), "grasp" (any wrench) or "basis".
  std::string forces = "";
  std::optional<double> mu = {};      ///< the friction coefficient, for "friction"
  std::vector<Direction> basis = {};  ///< the directions, for "basis"
  Surface surface = Surface::kPoint;  ///< where the end effector may touch
  Pose<double> frame = {};  ///< contact frame in the world, its z axis into the environment
  std::optional<double> radius = {};  ///< radius of a circle [m]
  Eigen::VectorXd min = {},  ///< lower limits of the regrasp coordinates [m; rad of a circle];
                             ///< empty for a point
      max = {},              ///< upper limits, likewise
      initial = {};          ///< default values, likewise
  std::vector<std::string> joints = {};  ///< the dependent joints of the contact, in the order of
                                         ///< the arm
  std::map<std::string, double> rest = {};  ///< rest values of other joints of the arm [rad or m];
                                            ///< 0 if missing
  double length_scale = Contact().length_scale;  ///< as `Contact::length_scale` [m]
  double sigma_min = Contact().sigma_min;        ///< as `Contact::sigma_min` [-]
};

/// What is not known of a robot and its water, the table `[uncertainty]` of a file. Each number is
/// half of the width of an interval about the nominal value, unless stated otherwise.
struct UncertaintySpec {
  std::map<std::string, double> mass = {},  ///< masses by name of `Robot::parts` [kg]
      volume = {};                          ///< displaced volumes, likewise [m^3]
  std::map<std::string, Eigen::Vector3d> com =
                                             {},  ///< centres of mass, in the axes of the part [m]
      cob = {};                                   ///< centres of buoyancy, likewise [m]
  double trim = 0;                                ///< the mass that the trim carries [kg]
  double payload_mass = 0;  ///< an unknown mass between zero and this one at the end effector [kg]
  /// The centre of that mass, in the axes of the end effector [m].
  Eigen::Vector3d payload_com = Eigen::Vector3d::Zero();
  double thrust = 0,  ///< the share, less than 1, by which each thruster may be weaker [-]
      torque = 0;     ///< the share by which each joint's motor may be weaker [-]
  /// The speed of a steady horizontal current from any of `current_directions` directions, the
  /// first along x, or of none [m/s].
  double current_speed = 0;
  int current_directions = 72;                        ///< the number of directions
  std::vector<Eigen::Vector3d> current_vectors = {};  ///< in place of both: velocities in the world
                                                      ///< [m/s]; add zero for still water
};

/// The actuators that may be lost, the table `[loss]` of a file.
struct LossSpec {
  int any = 0;  ///< at most so many of `actuators` are lost at once, in every combination
  /// Names of thrusters and joints, "thrusters" or "joints" for all of them.
  std::vector<std::string> actuators = {"thrusters"};
  /// In place of both: the sets of actuators that may be lost.
  std::vector<std::vector<std::string>> cases = {};
  bool joints_lock = false;  ///< true: a lost joint is locked by its brake; false: it is limp
  double friction = 0;       ///< what a limp joint resists [N m or N]
  double brake = kInfinity;  ///< what a locked joint resists [N m or N]
};

/// A payload whose mass is the value, the table `[payload]` of a file. Lengths are in the axes of
/// the end effector.
struct PayloadSpec {
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< centre of mass [m]
  double volume = 0;                              ///< displaced volume per kg [m^3/kg]
  std::optional<Eigen::Vector3d> cob = {};        ///< centre of buoyancy [m]; none: `com`
  /// Inertia about the centre of mass per kg, of a possible body [m^2]. At rest it does not count.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  /// Added mass about the centre of mass per kg: along the axes [-], and about them [m^2]. At rest
  /// it does not count.
  Vector6d added_mass = Vector6d::Zero();
};

/// The description of a task; `make_problem` derives everything else in a `Problem`.
struct TaskSpec {
  std::string name = "",          ///< as `Problem::name`, free text
      label = "",                 ///< as `Problem::label`, free text
      source = "";                ///< as `Problem::source`, free text
  Robot robot = {};               ///< the robot as `finalize` returns it
  std::string end_effector = "";  ///< the name of the end effector
  /// The pose of the end effector in the world; the start of a path.
  Pose<double> pose = {};
  /// In place of `pose`: joint positions [rad or m], by name, that put the end effector there. The
  /// base is at its mount, and other joints rest. They are also the default and the guess, unless
  /// these are given.
  std::optional<std::map<std::string, double>> posture = {};
  /// The coordinates of the pose that a static task leaves free, by their names in kTwistAxes.
  std::vector<std::string> free = {};
  /// Limits [min, max] of coordinates of the pose [m; rad], by their names in kTwistAxes. A
  /// translation needs limits. A coordinate with limits is free.
  std::map<std::string, std::array<double, 2>> range = {};
  /// true: these coordinates are along the axes of the end effector; false: along those of `pose`.
  bool along_end_effector = false;
  Vector6d c = Vector6d::Zero();  ///< direction [force; torque], of any nonzero length
  /// In place of c: several wrenches, of any nonzero length. The value is the factor by which all
  /// of them can be exerted, one at a time.
  std::vector<Vector6d> set = {};
  /// Axes of a ball, by names in kWrenchAxes, all of forces or all of torques: with a radius it is
  /// added to c or to each wrench of `set`, or stands alone.
  std::vector<std::string> ball_axes = {};
  double ball_radius = 0;  ///< radius of the ball [N or N m]
  bool hold = false;       ///< whether the robot must also hold its posture without a wrench
  /// Steady velocity of the water in the world [m/s]; none: that of the robot.
  std::optional<Eigen::Vector3d> current = {};
  std::optional<UncertaintySpec> uncertainty = {};  ///< what is not known
  std::optional<LossSpec> loss = {};                ///< the actuators that may be lost
  std::optional<PayloadSpec> payload = {};          ///< in place of a wrench
  /// true: c, `set`, the ball, `any` and `desired` are in the axes of the end effector and turn
  /// with it. false: they are in world axes.
  bool wrench_in_end_effector = false;
  /// The wrenches that `Wrench::kAny` allows, by names in kWrenchAxes. None: all that do work.
  std::optional<std::vector<std::string>> any = {};
  double reference = 1;                     ///< as `Problem::reference`
  std::optional<Vector6d> desired = {};     ///< as `Problem::desired`
  std::optional<ContactSpec> contact = {};  ///< second contact of a static task
  /// The task in time. T follows from the path. For an impulse give T; its path is constant.
  /// c_turns follows from `wrench_in_end_effector`.
  std::optional<MotionTask> motion = {};
  /// Of a transfer: joint positions at its start and at its end [rad or m], by name. Others rest.
  std::map<std::string, double> from = {}, to = {};  ///< likewise at its end
  /// The redundant joints, if joints depend on theta_r in addition to the base. None: all joints of
  /// the chain are redundant.
  std::optional<std::vector<std::string>> joints = {};
  /// Default values of the redundant joints [rad or m]. Empty: zero within the limits, or a value
  /// where the pose is reached. For an impulse it is `MotionTask::theta_0`.
  Eigen::VectorXd theta_r_default = {};
  /// The dependent joints, by name [rad or m], of a posture near one at the default. It selects the
  /// IK solution. Empty: an IK solution is found.
  std::map<std::string, double>
      guess = {},
      guess_base = {};  ///< the free base axes of the same posture, by name [m; rad]
};

/// Checks a task and derives the members of its problem.
///
/// It derives dependent joints and their IK solutions, limits and a default of theta_r, W_any, and
/// the basis and rank of the contact.
///
/// @param spec  the task
/// @return the problem
/// @throws std::invalid_argument if a value is wrong.
Problem make_problem(const TaskSpec& spec);

}  // namespace maxwrench
