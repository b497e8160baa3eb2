#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "maxwrench/problem.h"
#include "maxwrench/task.h"

/// @file
/// Reads robots, tasks, trajectories and states from files.

namespace maxwrench {

/// Choices among what a robot's TOML file offers.
struct LoadOptions {
  /// The name of the table in `[limits]` whose efforts replace those of the URDF and of
  /// `[thrusters]`. Empty: none.
  std::string limits = "";
};

/// Reads a robot from a TOML file and the URDF that it names.
///
/// @throws std::invalid_argument with one line that names the file, the key, the value and what was
///         expected.
Robot load_robot(const std::filesystem::path& file, const LoadOptions& options = {});

/// How `load_urdf` completes a URDF.
struct UrdfOptions {
  /// The link that is the end effector. Empty: each link without children that a joint moves.
  std::string tool = "";
  /// The free axes of the base, as in `Robot::base_axes`. The base is parked: it may stand anywhere
  /// along them, and its brakes hold any load.
  std::vector<int> base_axes = {};
  std::filesystem::path srdf = {};  ///< collision pairs to leave out, and named postures; optional
  /// The named posture that gives the pose, for `make_urdf_problem`. Joints that `locks_undriven`
  /// locks stay there.
  std::string posture = "";
  /// Positions [rad or m]: a joint that `locks_undriven` locks stays there, in place of at rest.
  /// Other joints of the map only have to exist and to move.
  std::map<std::string, double> positions = {};
  /// Folders of packages, in which `package://` is searched before other places.
  std::vector<std::filesystem::path> packages = {};
  /// The group of the SRDF whose joints alone move; without `tool`, its tips are the end effectors.
  /// Empty: all joints move.
  std::string group = "";
  /// The named posture of the SRDF in which joints outside of the group are locked. Empty: that of
  /// `posture`; without it they are at rest.
  std::string rest_posture = "";
  /// Positions of joints outside of the group [rad or m], in place of those of that posture.
  std::map<std::string, double> rest = {};
  /// Whether a joint without effort that does not carry `tool` is locked. Forces need that;
  /// positions do not.
  bool locks_undriven = true;
};

/// Makes a robot from a URDF alone.
///
/// @throws std::invalid_argument as `load_robot`.
Robot load_urdf(const std::filesystem::path& urdf, const UrdfOptions& options = {});

/// Makes a static task of a robot's URDF alone. The program chooses the redundant joints.
///
/// @param urdf     the URDF
/// @param options  the robot
/// @param task     pose or posture, wrench and others; `TaskSpec::robot` and, if it is empty,
///                 `TaskSpec::end_effector` are set here. Without a posture,
///                 `UrdfOptions::posture` gives it. A posture without joints is that at
///                 rest; if the end effector cannot move from there in all its directions, or
///                 bodies collide, another posture is chosen. Joints of `UrdfOptions::positions`
///                 that are locked are left out of the posture.
/// @throws std::invalid_argument as `load_robot`.
Problem make_urdf_problem(const std::filesystem::path& urdf, const UrdfOptions& options,
                          TaskSpec task);

/// Reads a task and its robot.
///
/// @param name     the name of a shipped problem, such as "planar/force", or the path of a task
/// file
/// @param options  the robot
/// @throws std::invalid_argument as `load_robot`.
Problem load_problem(const std::string& name, const LoadOptions& options = {});

/// Returns whether a TOML file describes a task rather than a robot.
///
/// A task names a robot. The function reads only the keys before the first table. It does not
/// report other errors of the file; loading the file does.
///
/// @throws std::invalid_argument if there is nothing to read.
bool is_task(const std::filesystem::path& file);

/// Returns the tasks in a folder and its subfolders: paths without their extension, sorted.
///
/// A broken file is included; loading it throws.
std::vector<std::string> tasks_in(const std::filesystem::path& folder);

/// Returns the folder of the shipped problems, or an empty path if there is none.
///
/// It is the folder in the environment variable MAXWRENCH_PROBLEMS if that is set. Otherwise it is
/// the first of these that exists: problems beside the shared library or Python module that
/// holds this function, share/maxwrench/problems beside the folder of the running program, the
/// source tree, the folder where maxwrench was to be installed.
///
/// @throws std::invalid_argument if the variable does not name a folder.
std::filesystem::path problems_folder();

/// Returns the names of the problems in `problems_folder`, sorted.
std::vector<std::string> shipped_problems();

/// Reads a table of knots from a CSV file.
///
/// The table has k rows of r numbers [rad or m], without knot 0 of an impulse. A static problem has
/// one row. A first line with the names of the coordinates is optional. The function does not check
/// limits.
///
/// @param file     the CSV file
/// @param problem  the task
/// @return the knots of theta_r (k×r)
/// @throws std::invalid_argument as `load_robot`.
Eigen::MatrixXd load_knots(const std::filesystem::path& file, const Problem& problem);

/// Returns knots (k×r) as a CSV table that `load_knots` reads, each number with all its digits.
std::string knots_csv(const Problem& problem, const Eigen::MatrixXd& knots);

/// The state of a robot at one instant of a motion.
struct State {
  Pose<double> base;         ///< pose of the base in the world
  Eigen::VectorXd q;         ///< positions of all joints [rad or m]
  Eigen::VectorXd velocity,  ///< velocities (n): free base axes in base axes, then joints
      acceleration;          ///< derivative of `velocity` (n)
};

/// Reads a state from a TOML file.
///
/// The table `[theta]` has the `position` and `rpy` of the base in the world, and each joint by its
/// name. The base may differ from its mount along the free axes only. `velocity` and `acceleration`
/// have n numbers each, and are zero if they are missing.
///
/// @param file   the TOML file
/// @param robot  the robot
/// @throws std::invalid_argument as `load_robot`.
State load_state(const std::filesystem::path& file, const Robot& robot);

}  // namespace maxwrench
