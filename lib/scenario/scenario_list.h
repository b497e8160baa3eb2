#pragma once

#include <string>

#include "maxwrench/capability.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

/// Moves to the next scenario of a list, the cases of the last load first; false after the last
/// one. The first one has zeros throughout.
bool next(const ScenarioList& list, ScenarioChoice& choice);

/// Throws std::invalid_argument, which names `what`, if the task has a list of scenarios.
void require_no_scenarios(const Problem& problem, const std::string& what);

}  // namespace maxwrench
