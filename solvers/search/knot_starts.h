#pragma once

#include <vector>

#include "maxwrench/trajectory.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// The fewest evaluations with which it is useful to start a local search.
inline constexpr long kFewestOfLocalSearch = 6;

/// The only place that checks whether an objective is one of trajectories; null if it is not.
TrajectoryObjective* as_trajectories(Objective& objective);
/// Throws std::invalid_argument, which names the search, if the objective is not one of
/// trajectories.
TrajectoryObjective& require_trajectories(Objective& objective, const char* search);

/// Evaluates the search's start and tables drawn around it that satisfy the rows of the limits. All
/// knots of a table move by the same offset. Knots of an impulse move separately, because a common
/// offset violates the fixed start at once. Returns the tables that have a value, best first in
/// rounds: each round takes the tables that are apart from those it has taken. The values are those
/// at the instants, whatever value the objective uses. Adds all evaluations to `found`, of the
/// objective or of another value.
std::vector<Candidate> draw_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found);

/// The best points of an earlier search that have a value at their instants, with that value, at
/// most eight. Adds the evaluations to `found`.
std::vector<Candidate> earlier_starts(const TrajectoryObjective& objective,
                                      const SearchOptions& options, SearchRun& run, Part& found);

/// The starts of the local searches of `slp`. For a task other than an impulse, each drawn table is
/// first optimised with all knots moving alike (`SlpRun`). This costs little and reduces hundreds
/// of tables to a few families. The results come first, then the drawn tables. Empty if no table
/// has a value.
std::vector<Candidate> find_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found);

/// The starts of the local searches of `slp` where the task has a coarser objective. With that one,
/// tables are drawn, then optimised with all knots moving alike, and the best of each family with
/// knots of their own. The clamped splines through the results give tables of the task, shortened
/// so far that they satisfy the rows of the limits. They come in the order of the coarse values;
/// the search's start is the last one. Empty if there is no coarser objective, if the budget is too
/// small, or if no table has a value.
std::vector<Candidate> find_coarse_starts(TrajectoryObjective& objective,
                                          const SearchOptions& options, SearchRun& run,
                                          Part& found);

/// Tables near a trajectory, numbers `first` to `first` + `count` - 1 of an endless series. The
/// knots move alike or separately, those of an impulse always separately, by 0.05 to 0.8 [rad or m]
/// at most, and satisfy the rows of the limits. Returns the tables that have a value: where a local
/// search has stalled, another from nearby may not. Adds the evaluations to `found`.
std::vector<Candidate> kick_knots(TrajectoryObjective& objective, const SearchOptions& options,
                                  const Candidate& best, long first, long count, SearchRun& run,
                                  Part& found);

}  // namespace maxwrench
