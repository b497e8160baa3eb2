#include <algorithm>
#include <cmath>

#include "solvers/lp/simplex/engine.h"

namespace maxwrench::simplex {
namespace {

/// A free column must end in the basis, so its box is the widest.
constexpr double kFreeBox = 1000;

}  // namespace

/// The dual simplex needs a basis whose reduced costs have the right sign. For the program
///
///   min cost'x,   A x = 0,   0 <= x_j <= 1 (only a lower bound), -1 <= x_j <= 0 (only an upper
///   one), -1000 <= x_j <= 1000 (free), x_j = 0 (boxed, where the sign does not matter),
///
/// every basis is one, after its columns move to the right bound. If the optimum is zero, the
/// optimal basis is one for the true bounds as well. Otherwise no basis is, and the dual simplex
/// has to shift costs. (Koberstein 2005, section 4.4.)
Outcome Engine::find_dual_feasible_basis() {
  homogeneous_ = true;
  for (int j = model.rows; j < model.total; ++j) {
    const bool low = std::isfinite(lower[j]), high = std::isfinite(upper[j]);
    lower[j] = low ? 0 : high ? -1 : -kFreeBox;
    upper[j] = high ? 0 : low ? 1 : kFreeBox;
    if (state[j] != VariableState::kBasic) state[j] = VariableState::kAtLower;
  }
  for (int p = 0; p < model.rows; ++p) load_position(p);
  compute_primal();
  const Outcome outcome = dual();
  homogeneous_ = false;
  reset_bounds_and_costs();
  std::fill(excused_.begin(), excused_.end(), 0.0);
  for (int j = model.rows; j < model.total; ++j) {
    if (state[j] != VariableState::kBasic) state[j] = finite_bound(j);
  }
  compute_primal();
  // x = 0 is feasible, so a proof of the contrary is due to rounding.
  return outcome == Outcome::kInfeasible ? Outcome::kTrouble : outcome;
}

}  // namespace maxwrench::simplex
