#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/solve.h"

namespace maxwrench {

/// The name in a column of a product that stands for everything supported there.
inline constexpr const char* kAll = "all";

/// The usual budget of a trajectory search: one evaluation costs about a thousand times that of a
/// posture.
inline constexpr long kTrajectoryBudget = 5000;

/// Names for each column. An empty name is the default; `kAll` alone stands for all.
struct ProductColumns {
  using Names = std::vector<std::string>;
  Names measure = {Case().measure}, wrench = {"pure"}, solver = {""}, search = {""}, scheme = {""};
  std::vector<std::uint64_t> seed = {Case().seed};
  /// Evaluations, divided by the cost of the solver for a static task; if empty, the usual budget.
  std::optional<long> budget = std::nullopt;
  /// If empty: searches; otherwise experiments in the virtual tank, which do not search.
  Names integrator = {};
};

/// Every combination of the columns that a problem supports; may be empty. All searches are the
/// default and every single method.
std::vector<Case> product(const Problem& problem, const ProductColumns& columns);

/// Every measure × wrench × solver with two searches, `general_search` and `grid+cmaes` (the
/// comparison of solvers does not depend on the search), and × search with the first solver. For a
/// task in time: wrench × scheme × solver with the first search, and × search with the first
/// solver.
std::vector<Case> product(const Problem& problem, std::uint64_t seed, long budget);

/// The cases whose columns have the given values (column -> value); `seed` and `budget` do not
/// filter. Throws std::invalid_argument on an unknown column, or if no case is left.
std::vector<Case> select(std::vector<Case> cases, const std::map<std::string, std::string>& filter);

/// Sorts into the order of the rows of a table and removes duplicates.
void sort_cases(std::vector<Case>& cases);

}  // namespace maxwrench
