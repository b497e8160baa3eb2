#pragma once

#include <string>
#include <vector>

#include "maxwrench/capability.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

/// The difference of ends that rounding may cause, relative to 1 + their size: a posture whose
/// largest lo_s exceeds the least hi_s by no more has a value.
inline constexpr double kEndTolerance = 1e-9;

/// Moves to the next scenario of a list, the cases of the last load first; false after the last
/// one. The first one has zeros throughout.
bool next(const ScenarioList& list, ScenarioChoice& choice);

/// All scenarios of a list, in this order.
std::vector<ScenarioChoice> all_scenarios(const ScenarioList& list);

/// Throws std::invalid_argument, which names `what`, if the task has a list of scenarios.
void require_no_scenarios(const Problem& problem, const std::string& what);

}  // namespace maxwrench
