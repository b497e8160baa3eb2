#pragma once

#include <functional>
#include <limits>
#include <string>

#include "lib/math/random.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// A method that begins at a point and ends somewhere, and begins anew until the budget is used.
struct Climbing {
  const char* method;  ///< the search's name
  /// How many evaluations a climb should be able to use: so many climbs run side by side.
  long reach = 1000;
  long most = 8;                                   ///< at most so many side by side
  long starts = std::numeric_limits<long>::max();  ///< climbs, at most
  /// One climb in the unit cube: from a point with a value, until it has converged or the probe has
  /// no evaluation left. Returns how it ended. `random` is its own stream.
  using Climb = std::string(Probe& probe, const Box& box, const Candidate& start, Random& random);
  std::function<Climb> climb = {};
};

/// Climbs from `options.starts`, best first, or without any from `options.start`; then from
/// uniformly random points, each the first one with a value of those drawn. Drawing costs
/// evaluations; no other points than those are evaluated but by the climbs.
///
/// Up to `most` climbs run side by side, each with its share of the evaluations that are left. What
/// they did not use goes to the next ones, so their numbers and shares do not depend on threads.
/// Continues `found`, which may have used some of the budget.
void climb_from_starts(const Objective& objective, const Box& box, const SearchOptions& options,
                       const Climbing& climbing, SearchRun& run, Part& found);

/// A search that does nothing else.
SearchResult search_by_climbs(Objective& objective, const SearchOptions& options,
                              const Climbing& climbing);

/// Of a climb of a library.
inline constexpr const char* kBudgetUsed = "budget";

}  // namespace maxwrench
