#pragma once

#include <vector>

#include "maxwrench/trajectory.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// A local search of fewer evaluations is not worth its start.
inline constexpr long kFewestOfLocalSearch = 6;

/// The one place that asks whether an objective is one of trajectories; null: it is not.
TrajectoryObjective* as_trajectories(Objective& objective);
/// Throws std::invalid_argument, which names the search, unless it is.
TrajectoryObjective& require_trajectories(Objective& objective, const char* search);

/// The search's start and tables drawn around it that keep the rows of the limits, an offset for
/// all knots alike; or, as such a one leaves the start of an impulse at once, one for each knot.
/// Those that have a value, best first in rounds, each of which takes those that are apart from the
/// ones it has taken. Their values are those at the instants, whatever the objective counts. Adds
/// to `found` what was evaluated, of the objective or of something else.
std::vector<Candidate> draw_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found);

/// Where the local searches of `slp` begin. Drawn tables of one posture first local search as such,
/// all knots alike (`SlpRun`), which costs little and of hundreds of tables leaves a few families:
/// these come first, then the tables as drawn. Empty if none has a value.
std::vector<Candidate> find_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found);

/// Tables near a trajectory, numbers `first` to `first` + `count` - 1 of an endless series: knots
/// moved alike or, always of an impulse, each by itself, by 0.05 to 0.8 [rad or m] at most, the
/// rows of the limits kept. Those that have a value: where a local search has stalled, another from
/// nearby may not. Adds to `found` what was evaluated.
std::vector<Candidate> kick_knots(TrajectoryObjective& objective, const SearchOptions& options,
                                  const Candidate& best, long first, long count, SearchRun& run,
                                  Part& found);

}  // namespace maxwrench
