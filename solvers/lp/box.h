#pragma once

#include <memory>

#include "lib/wrench_solver.h"

namespace maxwrench {

/// Any number of wrench columns, by a small dual simplex that starts at a sign vertex (`Tableau`).
/// Free columns that are as many as the rows without a direct drive are eliminated, and the efforts
/// of the thrusters are left (`Elimination`). Otherwise the efforts are eliminated, between the
/// facet pairs of {B u}:
///
///     max c_w'w   subject to   b_min - N'tau_d <= N'J'W w <= b_max - N'tau_d,   w_min <= w <=
///     w_max
///
/// with lambda = -N_B y_B. A directly driven joint is one of these rows, and so is a direction that
/// no actuator reaches.
///
/// Each call starts cold from the same rule: the answer depends on nothing but the program. What
/// has no facets and cannot be eliminated, a wrench that loads no actuator and whatever does not
/// check out goes to the general simplex on the assembled program, also cold.
std::unique_ptr<WrenchSolver> make_box();

}  // namespace maxwrench
