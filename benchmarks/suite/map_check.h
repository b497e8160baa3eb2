#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// What a check of the cells of a map found.
struct MapCheck {
  std::string problem;                ///< the name of its task
  std::size_t cells = 0,              ///< cells of the table
      checked = 0,                    ///< of these, the ones that were checked
      values = 0;                     ///< of these, the ones with a value
  std::vector<std::string> rejected;  ///< "cell 1,2: got ..., expected ..."
};

/// Evaluates the posture of each cell of a map again, or of `sample` cells drawn by `seed`; 0: all.
/// Nothing is written. A cell without a value has nothing to evaluate: only its place is checked.
///
/// @param folder  of `map --out`
/// @param load    loads the task by its name
/// @throws std::invalid_argument, in one line, if a file cannot be read or belongs to another task.
MapCheck check_map(const std::filesystem::path& folder,
                   const std::function<Problem(const std::string&)>& load, std::size_t sample,
                   std::uint64_t seed, int threads);

}  // namespace maxwrench
