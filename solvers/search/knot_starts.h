#pragma once

#include <vector>

#include "maxwrench/trajectory.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// A climb of fewer evaluations is not worth its start.
inline constexpr long kFewestOfClimb = 6;

/// The one place that asks whether an objective is one of plans; null: it is not.
PlanObjective* as_plans(Objective& objective);
/// Throws std::invalid_argument, which names the search, unless it is.
PlanObjective& require_plans(Objective& objective, const char* search);

/// The search's start and tables drawn around it that keep the rows of the limits, an offset for
/// all knots alike; or, as such a one leaves the start of a heave at once, one for each knot. Those
/// that have a value, best first in rounds, each of which takes those that are apart from the ones
/// it has taken. Their values are those at the instants, whatever the objective counts. Adds to
/// `found` what was evaluated, of the objective or of something else.
std::vector<Candidate> draw_knot_starts(PlanObjective& objective, const SearchOptions& options,
                                        SearchRun& run, Part& found);

/// Where the climbs of `slp` begin. Drawn tables of one posture first climb as such, all knots
/// alike (`KnotClimber`), which costs little and of hundreds of tables leaves a few families: these
/// come first, then the tables as drawn. Empty if none has a value.
std::vector<Candidate> find_knot_starts(PlanObjective& objective, const SearchOptions& options,
                                        SearchRun& run, Part& found);

/// Tables near a plan, numbers `first` to `first` + `count` - 1 of an endless series: knots moved
/// alike or, always of a heave, each by itself, by 0.05 to 0.8 [rad or m] at most, the rows of the
/// limits kept. Those that have a value: where a climb has stalled, another from nearby may not.
/// Adds to `found` what was evaluated.
std::vector<Candidate> kick_knots(PlanObjective& objective, const SearchOptions& options,
                                  const Candidate& best, long first, long count, SearchRun& run,
                                  Part& found);

}  // namespace maxwrench
