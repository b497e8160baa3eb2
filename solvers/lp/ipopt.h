#pragma once

#include <memory>

#include "lib/lp_solver.h"

namespace maxwrench {

/// Ipopt, a general interior point method, with settings for linear programs (Mehrotra's
/// predictor-corrector, no relaxed bounds). When it does not converge, the elastic program (least
/// 1-norm of A x - b) decides whether the program is infeasible: its multipliers are the Farkas
/// vector. Debian's build is not thread-safe, so all solves in a process stand behind one lock.
std::unique_ptr<LpSolver> make_ipopt();

}  // namespace maxwrench
