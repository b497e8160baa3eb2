#include "verify/proof_over_box.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace maxwrench {

std::vector<FormRow> to_rows(const std::vector<Form>& forms, const std::vector<double>& far) {
  std::vector<FormRow> rows;
  for (const Form& form : forms) rows.emplace_back(form, far);
  return rows;
}

double pure_ceiling(const Problem& problem, const FormModel& model, const Vector6d& c,
                    const Zonotope& set, const std::vector<Form>& tau) {
  const bool pushes = !c.head<3>().isZero(0);
  Wide length2, load2;
  for (int i = 0; i < 3; ++i) {
    const Wide x(c[pushes ? i : 3 + i]);
    length2 += x * x;
  }
  length2 = length2 * (Wide(1.0L) - Wide(model.shrinking()));
  std::array<bool, 3> free{};
  Wide force;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
    const int axis = problem.robot.base_axes[i];
    if ((axis < 3) != pushes) continue;
    free[static_cast<std::size_t>(axis % 3)] = true;
    rows.push_back(static_cast<Eigen::Index>(i));
    const Wide size(tau[i].magnitude(model.far()));
    load2 += size * size;
  }
  const FormVector at_base = model.along_at_base(c, pushes);
  for (std::size_t i = 0; i < 3; ++i) {
    if (free[i]) continue;
    const Wide lost(at_base[i].magnitude(model.far()));
    length2 -= lost * lost;
  }
  if (rows.empty() || !(length2.low > 1e-6L)) {
    throw std::invalid_argument(problem.name + ": the base's free axes do not limit c");
  }
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    Wide column2;
    for (const Eigen::Index row : rows) column2 += Wide(set.B(row, k)) * Wide(set.B(row, k));
    force += Wide(root_above(column2.high)) *
             Wide(std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])));
  }
  force += Wide(root_above(load2.high));
  const Wide length = Wide::below(std::sqrt(length2.low));
  return narrow(force / length).high;
}

double ProofOverBox::most(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                          const double* multiplier, std::size_t parts, double low, double high) {
  if (high <= low || !box_.set(lower, upper) || !off_postures_.set(lower, upper)) return high;
  const auto size = static_cast<std::size_t>(model_.shape().size);
  tau_.assign(size, 0.0);
  a_.assign(size, 0.0);
  const double support = combine(multiplier, parts, tau_, a_);
  box_.over_box(tau_);
  box_.over_box(a_);
  off_postures_.add_to(tau_, nu(multiplier, parts));
  if (!add_at_points(lower, upper, multiplier, tau_)) return high;
  double U = by_ends(support, low, high);
  if (U > low) U = std::min(U, by_ratio(support));
  return U < high ? U : high;
}

double ProofOverBox::by_ends(double support, double low, double high) const {
  double most = -kInfinity;
  for (std::size_t v = 0; v < tau_.size(); ++v) {
    const Narrow slope = Narrow(1.0) - a_[v];
    const Narrow at_low = Narrow(low) * slope - tau_[v], at_high = Narrow(high) * slope - tau_[v];
    if (!(at_low.high < kInfinity && at_high.high < kInfinity)) return kInfinity;  // or NaN
    most = std::max(most, std::max(at_low.high, at_high.high));
  }
  return Narrow::above(support + most);
}

double ProofOverBox::by_ratio(double support) const {
  double most = -kInfinity;
  for (std::size_t v = 0; v < tau_.size(); ++v) {
    if (!(a_[v].low > 0)) return kInfinity;
    const Narrow ratio = (Narrow(support) - tau_[v]) / a_[v];
    if (!(ratio.high < kInfinity)) return kInfinity;
    most = std::max(most, ratio.high);
  }
  return most;
}

}  // namespace maxwrench
