#pragma once

#include <functional>
#include <limits>
#include <string>

#include "lib/math/random.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// A method that begins at a point and ends somewhere, and begins anew until the budget is used.
struct LocalSearch {
  const char* method;  ///< the search's name
  /// How many evaluations a local search should be able to use: so many local searches run side by
  /// side.
  long evaluations_per_run = 1000;
  long max_parallel = 8;                           ///< at most so many side by side
  long starts = std::numeric_limits<long>::max();  ///< local searches, at most
  /// One local search in the unit cube: from a point with a value, until it has converged or the
  /// probe has no evaluation left. Returns how it ended. `random` is its own stream.
  using Run = std::string(Probe& probe, const Box& box, const Candidate& start, Random& random);
  std::function<Run> optimise = {};
};

/// Local searches from `options.starts`, best first, or without any from `options.start`; then from
/// uniformly random points, each the first one with a value of those drawn. Drawing costs
/// evaluations; no other points than those are evaluated but by the local searches.
///
/// Up to `max_parallel` local searches run side by side, each with its share of the evaluations
/// that are left. What they did not use goes to the next ones, so their numbers and shares do not
/// depend on threads. Continues `found`, which may have used some of the budget.
void multistart_from(const Objective& objective, const Box& box, const SearchOptions& options,
                     const LocalSearch& local_search, SearchRun& run, Part& found);

/// A search that does nothing else.
SearchResult multistart_search(Objective& objective, const SearchOptions& options,
                               const LocalSearch& local_search);

/// Of a local search of a library.
inline constexpr const char* kBudgetUsed = "budget";

}  // namespace maxwrench
