#pragma once

#include "maxwrench/lp_solver.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// Efforts for a known wrench: fills u of the capability with a vertex of {u : B u = tau_d + J'W w,
/// u_min <= u <= u_max}, w as in the capability. If rounding left w just outside the set, w and
/// beta move to the best wrench within 1e-8 of it. If there are no such efforts, the status becomes
/// kNumericalError. Allocates memory, so do not call it in the hot loop.
void fill_efforts(const WrenchProgram& program, LpSolver& solver, Capability& capability);

}  // namespace maxwrench
