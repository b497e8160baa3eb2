#pragma once

#include "maxwrench/lp_solver.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// Efforts for a wrench that is already known: fills u of the capability with a vertex of
/// {u : B u = tau_d + J'W w, u_min <= u <= u_max}, w as in the capability. If rounding left w just
/// outside of the set, w and beta move to the best wrench within 1e-8 of it. Without such efforts
/// the status becomes kNumericalError. Not for the hot loop: it allocates.
void fill_efforts(const WrenchProgram& program, LpSolver& solver, Capability& capability);

}  // namespace maxwrench
