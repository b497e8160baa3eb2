#pragma once

#include <functional>
#include <limits>
#include <string>

#include "lib/math/random.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// A local search, which is started again until the budget is used.
struct LocalSearch {
  const char* method;  ///< the search's name
  /// The evaluations that one local search should have. They determine how many run in parallel.
  long evaluations_per_run = 1000;
  long max_parallel = 8;                           ///< limit of parallel local searches
  long starts = std::numeric_limits<long>::max();  ///< limit of local searches
  /// One local search in the unit cube, from a point with a value, until it converges or the probe
  /// has no evaluation left. Returns its status. `random` is a stream of its own.
  using Run = std::string(Probe& probe, const Box& box, const Candidate& start, Random& random);
  std::function<Run> optimise = {};
};

/// Local searches from `options.starts`, best first, or from `options.start` if there are none.
/// Then from uniformly random points: points are drawn until one has a value. Each draw costs an
/// evaluation.
///
/// Up to `max_parallel` local searches run in parallel, each with its share of the remaining
/// evaluations. What they do not use passes to the next ones, so their numbers and shares do not
/// depend on threads. Continues `found`, which may have used some of the budget.
void multistart_from(const Objective& objective, const Box& box, const SearchOptions& options,
                     const LocalSearch& local_search, SearchRun& run, Part& found);

/// A search that consists only of these local searches.
SearchResult multistart_search(Objective& objective, const SearchOptions& options,
                               const LocalSearch& local_search);

/// The status of a local search that used its budget.
inline constexpr const char* kBudgetUsed = "budget";

}  // namespace maxwrench
