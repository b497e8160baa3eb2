#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/output.h"
#include "maxwrench/load.h"

namespace maxwrench {

/// Whether PROBLEM is a URDF or xacro file rather than a task or a robot in TOML.
bool is_urdf(const std::string& problem);

/// The warnings of a robot, and its links without dynamics, one line each.
std::vector<std::string> warnings_of(const Robot& robot);

/// What makes a robot and a static task of a URDF, and what chooses among the limits of a robot in
/// TOML. All are texts until they are parsed.
struct ProblemOptions {
  std::optional<std::string> tool, base, wrench_along, wrench_frame, at, joints, posture, srdf,
      group, rest;
  std::optional<std::string> limits;
  std::vector<std::string> packages;
  bool counts_warnings = true;  ///< whether `load` says how many warnings the robot has, and which
                                ///< pose was chosen
  bool locks_undriven = true;   ///< as in `UrdfOptions`

  void add(CLI::App& app);        ///< all
  void add_robot(CLI::App& app);  ///< base, srdf, group, rest, packages, tool, limits
  void add_joints(CLI::App& app, const char* what);  ///< joints, posture

  /// Whether the posture or the pose is given by joints.
  bool gives_joints() const { return joints || posture; }
  /// Whether an option describes a task rather than a robot.
  bool describes_task() const;
  /// The files that the command reads.
  std::vector<NamedFile> inputs(const std::string& problem) const;

  /// Loads a task: by its name, its file, or made of a URDF. Keeps one line for stderr if the robot
  /// has warnings, and one if the program chose the pose.
  ///
  /// @param evaluates_joints  whether the command evaluates the given joints themselves; otherwise
  ///                          they give the pose of a URDF's task
  Problem load(const std::string& problem, bool evaluates_joints = false) const;
  /// Loads a robot: a URDF, a robot file, or that of a task.
  Robot load_robot(const std::string& file) const;
  /// The positions of all joints that the options give; other joints are at rest.
  ///
  /// @param of_urdf  whether the robot was made of a URDF with these options
  Eigen::VectorXd positions(const Robot& robot, bool of_urdf) const;

 private:
  void reject_for_toml(const std::string& problem, bool evaluates_joints) const;
  UrdfOptions urdf_options() const;
  TaskSpec task(const std::string& problem, bool evaluates_joints) const;
};

}  // namespace maxwrench
