#pragma once

#include <memory>

#include "lib/lp_solver.h"
#include "lib/wrench_solver.h"

namespace maxwrench {

/// Any general LP solver on the assembled program, warm-started from call to call.
std::unique_ptr<WrenchSolver> make_assembled(std::unique_ptr<LpSolver> solver);

}  // namespace maxwrench
