#include <algorithm>
#include <cmath>

#include "solvers/trajectory/forms.h"

// The order of the efforts, and which of them one form replaces.

namespace maxwrench {
namespace {

/// A row of Z below this is a rounding error: the null space does not move the actuator.
constexpr double kStill = 1e-12;
/// An effort that w moves less than this, relative to the largest, does not limit w.
constexpr double kSlight = 1e-6;

}  // namespace

/// Actuators with rates or a lag come first; those without rates that the null space of B does not
/// move come last.
void Forms::order_actuators(const TrajectoryProgram& program, bool with_rates) {
  const int m = actuation_->actuators();
  const auto has_rate = [&](int j) {
    for (int i = 0; i + 1 < N; ++i) {
      if (program.du_max(j, i) < kInfiniteBound || program.lags(j, i)) return true;
    }
    return false;
  };
  order.clear();
  rated = lone = 0;
  for (int j = 0; j < m; ++j) {
    if (has_rate(j)) order.push_back(j);
  }
  if (with_rates) rated = static_cast<int>(order.size());
  lagged = with_rates && program.lag.size() > 0 && (program.lag.array() > 0).any();
  for (const bool moved : {true, false}) {
    for (int j = 0; j < m; ++j) {
      if (has_rate(j) || (Z_.row(j).lpNorm<1>() > kStill) != moved) continue;
      order.push_back(j);
      lone += !moved;
    }
  }
  B_pinv_.resize(m, actuation_->dimension());
  Z_ordered_.resize(m, Z_.cols());
  for (int r = 0; r < m; ++r) {
    B_pinv_.row(r) = actuation_->B_pinv.row(order[r]);
    Z_ordered_.row(r) = Z_.row(order[r]);
  }
}

/// The w at which the effort of a row reaches the limit that bounds w from above or from below.
double Forms::end_of_w(const TrajectoryProgram& program, int i, int r, bool high) const {
  const int j = order[r];
  const double slope = slopes_(r, i);
  const double limit = high == (slope > 0) ? program.u_max(j, i) : program.u_min(j, i);
  return (limit - offsets_(j, i)) / slope;
}

/// Computes offsets, slopes and, if only w moves the lone efforts, which of them limit w. If their
/// limits contradict each other, they stay separate, for the proof.
void Forms::merge(const TrajectoryProgram& program, int i) {
  Stage& at = stages[i];
  const WrenchProgram& data = program.instants[i];
  offsets_.col(i).noalias() = actuation_->B_pinv.lazyProduct(data.tau_d);
  at.lowest = at.highest = -1;
  if (data.columns() != 1) return;
  slopes_.col(i).noalias() = B_pinv_.lazyProduct(data.JtW);
  const auto m = static_cast<int>(order.size());
  if (lone == 0 || p > 0 || at.elastic) return;
  const double flat = kSlight * slopes_.col(i).lpNorm<Eigen::Infinity>();
  int lowest = -1, highest = -1;
  double low = -kInfinity, high = kInfinity;
  for (int r = m - lone; r < m; ++r) {
    if (std::abs(slopes_(r, i)) <= flat) continue;
    if (end_of_w(program, i, r, false) > low) low = end_of_w(program, i, lowest = r, false);
    if (end_of_w(program, i, r, true) < high) high = end_of_w(program, i, highest = r, true);
  }
  if (lowest < 0 || highest < 0 || !(low < high)) return;
  // Efforts that hardly depend on w must be within their limits over the whole interval.
  for (int r = m - lone; r < m; ++r) {
    if (std::abs(slopes_(r, i)) > flat) continue;
    const int j = order[r];
    for (const double w : {low, high}) {
      const double u = offsets_(j, i) + slopes_(r, i) * w;
      if (!(program.u_min(j, i) <= u && u <= program.u_max(j, i))) return;
    }
  }
  at.lowest = lowest;
  at.highest = highest;
}

/// The multiplier of the effort in a row. The multiplier of w belongs to the effort that limits it.
double Forms::effort_multiplier(const Eigen::VectorXd& multipliers, int i, int r) const {
  const Stage& at = stages[i];
  if (r < at.efforts) return multipliers[at.f0 + r];
  const double held = multipliers[at.f0 + at.efforts];
  return r == (held > 0 ? at.highest : at.lowest) ? held / slopes_(r, i) : 0;
}

}  // namespace maxwrench
