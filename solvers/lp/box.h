#pragma once

#include <memory>

#include "lib/wrench_solver.h"

namespace maxwrench {

/// Any number of wrench columns between the facet pairs of {B u}: the efforts are eliminated, and
///
///     max c_w'w   subject to   b_min - N'tau_d <= G w <= b_max - N'tau_d,   w_min <= w <= w_max
///
/// with G = N'J'W is left: few columns, rows with two bounds each (a directly driven joint is one
/// of them, and so is a direction that no actuator reaches). A basis is k rows that hold with
/// equality, T = [G; I] G_B^-1 and y = G_B^-T c_w. Every basis is dual feasible once each of its
/// rows rests on the bound that the sign of its y asks for, so the dual simplex needs no first
/// phase; its ratio test flips rows to their other bound as long as that helps. The answer is
/// refined and checked from the data, lambda = -N_B y_B.
///
/// Each call starts cold from the same rule: the answer depends on nothing but the program. A
/// zonotope without facets, a wrench that loads no actuator and whatever does not check out goes to
/// the general simplex on the assembled program, also cold.
std::unique_ptr<WrenchSolver> make_box();

}  // namespace maxwrench
