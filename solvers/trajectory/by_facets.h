#pragma once

#include "maxwrench/trajectory_program.h"

namespace maxwrench {

/// Whether the facets of {B u} bound t at each instant separately: a max-min program of one wrench
/// column without limits and without a common factor, whose first instants have the same limits as
/// the others. Rates and slacks are ignored.
bool bounded_by_facets(const TrajectoryProgram& program);

/// Whether all sets {B u} have facets, and the first instant of each scenario has the same limits
/// as the others.
bool starts_anywhere(const TrajectoryProgram& program);

}  // namespace maxwrench
