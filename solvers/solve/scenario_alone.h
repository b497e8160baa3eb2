#pragma once

#include "verify/trajectory/scenario_task.h"

namespace maxwrench {

/// Number `i` of the scenarios as a task of its own, complete with facets, rank and pseudo-inverse
/// of its actuators.
ScenarioTask scenario_alone(const Problem& problem, int i);

}  // namespace maxwrench
