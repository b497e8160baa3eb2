#pragma once

#include <memory>

#include "lib/wrench_solver.h"

namespace maxwrench {

/// One wrench column a = J'W by ray shooting through the facet pairs of {B u}: with w = x,
///
///     b_min <= N'(tau_d + a x) <= b_max
///
/// bounds x from both sides, pair by pair; the optimum is the tightest bound on the side of c_w and
/// lambda = -c_w n_j / (n_j'a) of the active pair. No pivot, no iteration. Throws
/// std::invalid_argument on several columns or a zonotope without facets.
std::unique_ptr<WrenchSolver> make_facets();

}  // namespace maxwrench
