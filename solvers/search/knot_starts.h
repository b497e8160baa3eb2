#pragma once

#include <vector>

#include "maxwrench/plan.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// Where the climbs of `slp` begin: the search's start and tables drawn around it that keep the
/// rows of the limits, an offset for all knots alike; or, as such a one leaves the start of a heave
/// at once, one for each knot. Those of one posture first climb as such, all knots alike
/// (`KnotClimber`), which costs little and of hundreds of tables leaves a few families.
///
/// Adds to `found` what was evaluated. First the families, best first; then the tables as drawn, in
/// rounds, each of which takes those that are apart from the ones it has taken. Empty if none has a
/// value.
std::vector<Candidate> find_knot_starts(Objective& objective, const SearchOptions& options,
                                        EvaluationCounter& progress, Part& found);

}  // namespace maxwrench
