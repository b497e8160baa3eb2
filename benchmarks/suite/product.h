#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/solve.h"

namespace maxwrench {

/// What a column of a product lists to mean everything that has a meaning there.
inline constexpr const char* kAll = "all";

/// What is usual for a trajectory search: one evaluation costs about a thousand times that of a
/// posture.
inline constexpr long kTrajectoryBudget = 5000;

/// Names column by column; an empty name is the default, `kAll` alone every one.
struct ProductColumns {
  using Names = std::vector<std::string>;
  Names measure = {Case().measure}, wrench = {"pure"}, solver = {""}, search = {""}, scheme = {""};
  std::vector<std::uint64_t> seed = {Case().seed};
  /// Evaluations, divided by the cost of the solver for a static task; none: what is usual.
  std::optional<long> budget = std::nullopt;
  /// None: searches; else experiments in the virtual tank, which search nothing.
  Names integrator = {};
};

/// Every combination of the columns that has a meaning on a problem, none if none has. All searches
/// are the default and every method alone.
std::vector<Case> product(const Problem& problem, const ProductColumns& columns);

/// Every measure × wrench × solver with two searches, `general_search` and `grid+cmaes` (what a
/// solver is worth does not depend on the search), and × search with the first solver. Of a task in
/// time: wrench × scheme × solver with the first search, and × search with the first solver.
std::vector<Case> product(const Problem& problem, std::uint64_t seed, long budget);

/// Of `cases`, those whose columns have the given values (column -> value); `seed` and `budget` are
/// no filters. Throws std::invalid_argument on an unknown column, or if no case is left.
std::vector<Case> select(std::vector<Case> cases, const std::map<std::string, std::string>& filter);

/// Each case once, in the order of the rows of a table.
void sort_cases(std::vector<Case>& cases);

}  // namespace maxwrench
