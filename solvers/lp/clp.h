#pragma once

#include <memory>

#include "lib/lp_solver.h"

namespace maxwrench {

/// Clp, COIN-OR's simplex library, silent: the dual simplex with bounds and costs unperturbed.
/// Every call loads the program afresh and then the kept basis, because an edit of Clp's matrix in
/// place drops explicit zeros. Proofs are its rays; where it has none, `prove_no_optimum`.
std::unique_ptr<LpSolver> make_clp();

}  // namespace maxwrench
