#pragma once

#include <memory>

#include "lib/lp_solver.h"
#include "lib/wrench_solver.h"

namespace maxwrench {

/// Any general LP solver on the assembled program, warm-started from call to call; or cold each
/// time, so that an answer does not depend on earlier calls.
std::unique_ptr<WrenchSolver> make_assembled(std::unique_ptr<LpSolver> solver, bool warm = true);

}  // namespace maxwrench
