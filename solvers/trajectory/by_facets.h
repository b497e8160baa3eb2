#pragma once

#include "maxwrench/trajectory_program.h"

namespace maxwrench {

/// Whether what the facets of {B u} allow at each instant by itself bounds t: a max-min program of
/// one wrench column without limits, whose first instant has the limits of the others. Rates and
/// slacks, which it may have, do not count.
bool bounded_by_facets(const TrajectoryProgram& program);

}  // namespace maxwrench
