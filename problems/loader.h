#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/problem.h"

namespace maxwrench {

/// Reads a robot: a TOML file and the URDF that it names. Throws std::invalid_argument with one
/// line that names file, key, value and what was expected.
Robot load_robot(const std::filesystem::path& file);

/// Reads a static task and its robot. `name` is a shipped problem such as "planar/force", or the
/// path of a task file. Errors as `load_robot`.
Problem load_problem(const std::string& name);

/// Whether a TOML file describes a task (it names a robot) rather than a robot.
bool is_task(const std::filesystem::path& file);

/// The names of the problems that come with maxwrench, sorted.
std::vector<std::string> shipped_problems();

}  // namespace maxwrench
