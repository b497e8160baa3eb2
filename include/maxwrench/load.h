#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// Reads a robot: a TOML file and the URDF that it names. Throws std::invalid_argument with one
/// line that names file, key, value and what was expected.
Robot load_robot(const std::filesystem::path& file);

/// Reads a task and its robot. `name` is a shipped problem such as "planar/force", or the
/// path of a task file. Errors as `load_robot`.
Problem load_problem(const std::string& name);

/// Whether a TOML file describes a task (it names a robot) rather than a robot. A look at the keys
/// before the first table: what else is wrong with the file shows when it is loaded. Throws
/// std::invalid_argument if there is nothing to read.
bool is_task(const std::filesystem::path& file);

/// The tasks in a folder and below it by path, without their ending, sorted. A broken file counts:
/// it is rejected when it is loaded.
std::vector<std::string> tasks_in(const std::filesystem::path& folder);

/// The folder of the shipped problems: the environment variable MAXWRENCH_PROBLEMS, else
/// share/maxwrench/problems beside the folder of the running program, the source tree, or where
/// maxwrench was to be installed; empty if none is there. Throws std::invalid_argument if the
/// variable names no folder.
std::filesystem::path problems_folder();

/// The names of the problems in that folder, sorted.
std::vector<std::string> shipped_problems();

/// Reads knots of theta_r from CSV: k rows of r numbers [rad or m], without knot 0 of an impulse;
/// one row for a static problem. A first line with the names of the coordinates may stand before
/// them. Errors as `load_robot`; limits are not looked at.
Eigen::MatrixXd load_knots(const std::filesystem::path& file, const Problem& problem);

/// Knots k×r as such a table, each number with all its digits.
std::string knots_csv(const Problem& problem, const Eigen::MatrixXd& knots);

/// One instant of a robot's motion.
struct State {
  Pose<double> base;                       ///< in the world
  Eigen::VectorXd q;                       ///< all joints
  Eigen::VectorXd velocity, acceleration;  ///< n, see lib/robot/dynamics.h
};

/// Reads a state from TOML: `[theta]` with the base's `position` and `rpy` in the world, which may
/// differ from the mount along the free axes only, and each joint by its name; `velocity`
/// and `acceleration` with n numbers, zero where they are missing. Errors as `load_robot`.
State load_state(const std::filesystem::path& file, const Robot& robot);

}  // namespace maxwrench
