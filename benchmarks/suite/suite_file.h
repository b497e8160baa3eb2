#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "maxwrench/problem.h"
#include "maxwrench/solve.h"

namespace maxwrench {

/// The work of a run: complete cases in the order of their rows, and their problems by name.
struct Workload {
  std::map<std::string, Problem> problems;
  std::vector<Case> cases;
  std::string suite;  ///< the text of the file, if there was one
};

/// Reads a suite: a TOML file with one or more `[[product]]`, each with `problem` and any of
/// `measure wrench solver search scheme` (a name, a list of names, or "all"), `seeds` (a number:
/// seeds 1 to this) and `budget`; or with `integrator` in place of `search`, `seeds` and `budget`.
/// Paths of task files are relative to the folder of the suite. Throws std::invalid_argument with
/// one line that names file, key, value and what was expected.
Workload read_suite_file(const std::filesystem::path& file);

}  // namespace maxwrench
