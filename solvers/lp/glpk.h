#pragma once

#include <memory>

#include "lib/lp_solver.h"

namespace maxwrench {

/// GLPK's dual simplex, silent. Every call loads the program afresh and then the kept basis,
/// because to edit and resolve was seen to give an "optimum" with wrong residuals. GLPK's
/// environment belongs to a thread: problems live only during a call, and each thread frees its
/// own. A Farkas vector is a row of the inverse basis; a ray comes from `prove_no_optimum`.
std::unique_ptr<LpSolver> make_glpk();

}  // namespace maxwrench
