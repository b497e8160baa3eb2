#include "solvers/lp/simplex/engine.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace maxwrench::simplex {
namespace {

constexpr double kRounding = 2 * std::numeric_limits<double>::epsilon();

double largest_magnitude(const std::vector<double>& v) {
  double largest = 0;
  for (const double x : v) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace

void Engine::resize() {
  factor.resize(model.rows, options.max_updates, model.sparse);
  const std::size_t m = model.rows, total = model.total;
  if (head.size() == m && state.size() == total) return;
  head.resize(m);
  state.resize(total);
  for (auto* v : {&lower, &upper, &cost, &d, &alpha_row, &weights_, &ratios_, &excused_})
    v->resize(total);
  for (auto* v : {&x_basic, &basic_lower, &basic_upper, &basic_tolerance, &y, &alpha_column, &rho,
                  &row_work_, &position_work_}) {
    v->resize(m);
  }
  for (auto* v : {&candidates_, &flipped_, &groups_}) {
    v->clear();
    v->reserve(total + 1);
  }
}

void Engine::start_attempt() {
  random_ = 0;
  std::fill(excused_.begin(), excused_.end(), 0.0);
  reset_bounds_and_costs();
}

void Engine::reset_bounds_and_costs() {
  lower = model.lower;
  upper = model.upper;
  cost = model.cost;
  bounds_shifted = false;
}

/// A number in [0.5, 1); the sequence is the same in every solve.
double Engine::jitter(int j) {
  random_ += 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(j);
  std::uint64_t z = random_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return 0.5 + 0.5 * static_cast<double>(z >> 11) * 0x1p-53;
}

VariableState Engine::finite_bound(int j) const {
  if (std::isfinite(lower[j])) return VariableState::kAtLower;
  return std::isfinite(upper[j]) ? VariableState::kAtUpper : VariableState::kFree;
}

void Engine::crash_basis() {
  for (int j = 0; j < model.total; ++j) {
    state[j] = finite_bound(j);
    if (state[j] == VariableState::kAtLower && std::abs(upper[j]) < std::abs(lower[j])) {
      state[j] = VariableState::kAtUpper;
    }
  }
  for (int i = 0; i < model.rows; ++i) head[i] = i;
  for (int j = model.rows; j < model.total; ++j) {
    const int e = model.start[j];
    if (model.start[j + 1] - e != 1 || std::abs(model.value[e]) < 0.05 || model.fixed[j]) continue;
    const int i = model.index[e];
    if (upper[j] - lower[j] > upper[head[i]] - lower[head[i]]) head[i] = j;
  }
  for (const int j : head) state[j] = VariableState::kBasic;
  refactor();
  for (int j = model.rows; j < model.total; ++j) {
    if (state[j] == VariableState::kFree) enter_free_column(j);
  }
}

/// Replaces a logical variable where the pivot is not small, otherwise any bounded variable.
void Engine::enter_free_column(int j) {
  if (factor.updates() == options.max_updates) refactor();
  column(j, alpha_column.data());
  int best = -1;
  double best_score = 0, largest = 0;
  for (int p = 0; p < model.rows; ++p) {
    const double a = std::abs(alpha_column[p]);
    largest = std::max(largest, a);
    if (!std::isfinite(basic_lower[p]) && !std::isfinite(basic_upper[p])) continue;
    const double score = head[p] < model.rows ? 10 * a : a;
    if (score > best_score) best_score = score, best = p;
  }
  if (best < 0 || std::abs(alpha_column[best]) < 0.01 * largest ||
      std::abs(alpha_column[best]) < options.pivot_tolerance) {
    return;
  }
  pivot(best, j,
        std::isfinite(basic_lower[best]) ? VariableState::kAtLower : VariableState::kAtUpper, 0);
}

bool Engine::refactor() {
  bool regular = true;
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (factor.factorise(model, head, options.singular_tolerance)) break;
    regular = false;
    for (const auto& [position, row] : factor.singular()) {
      const int j = head[position];
      if (state[row] == VariableState::kBasic) continue;
      state[j] = finite_bound(j);
      head[position] = row;
      state[row] = VariableState::kBasic;
    }
  }
  for (int p = 0; p < model.rows; ++p) {
    load_position(p);
  }
  return regular;
}

void Engine::compute_primal() {
  if (homogeneous_) {
    std::fill(row_work_.begin(), row_work_.end(), 0.0);
  } else {
    std::copy(model.b.begin(), model.b.end(), row_work_.begin());
  }
  for (int j = 0; j < model.total; ++j) {
    if (state[j] == VariableState::kBasic) continue;
    const double x = nonbasic_value(j);
    if (x == 0) continue;
    for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
      row_work_[model.index[e]] -= x * model.value[e];
    }
  }
  factor.ftran(row_work_.data(), x_basic.data());
  rounding = 1e-6 * options.primal_tolerance *
             std::max(largest_magnitude(x_basic), largest_magnitude(model.b));
}

void Engine::compute_dual() {
  for (int p = 0; p < model.rows; ++p) position_work_[p] = cost[head[p]];
  factor.btran(position_work_.data(), y.data());
  dual_rounding = 1e-6 * options.dual_tolerance * largest_magnitude(y);
  for (int j = model.rows; j < model.total; ++j) {
    if (state[j] == VariableState::kBasic) {
      d[j] = 0;
      continue;
    }
    double sum = cost[j];
    for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
      sum -= model.value[e] * y[model.index[e]];
    }
    d[j] = sum;
  }
}

void Engine::refine() {
  refine_primal();
  refine_dual();
}

/// A residual within a few units in the last place of its terms is ignored.
void Engine::refine_primal() {
  double size = 0;
  for (int i = 0; i < model.rows; ++i) {
    row_work_[i] = model.b[i];
    size = std::max(size, std::abs(model.b[i]));
  }
  const auto subtract = [&](int j, double x) {
    if (x == 0) return;
    for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
      const double term = x * model.value[e];
      row_work_[model.index[e]] -= term;
      size = std::max(size, std::abs(term));
    }
  };
  for (int j = 0; j < model.total; ++j) {
    if (state[j] != VariableState::kBasic) subtract(j, nonbasic_value(j));
  }
  for (int p = 0; p < model.rows; ++p) subtract(head[p], x_basic[p]);
  if (largest_magnitude(row_work_) <= kRounding * size) return;
  factor.ftran(row_work_.data(), position_work_.data());
  for (int p = 0; p < model.rows; ++p) x_basic[p] += position_work_[p];
}

void Engine::refine_dual() {
  double size = 0;
  for (int p = 0; p < model.rows; ++p) {
    double sum = cost[head[p]];
    size = std::max(size, std::abs(sum));
    for (int e = model.start[head[p]]; e < model.start[head[p] + 1]; ++e) {
      const double term = model.value[e] * y[model.index[e]];
      sum -= term;
      size = std::max(size, std::abs(term));
    }
    position_work_[p] = sum;
  }
  if (largest_magnitude(position_work_) <= kRounding * size) return;
  factor.btran(position_work_.data(), row_work_.data());
  for (int i = 0; i < model.rows; ++i) y[i] += row_work_[i];
}

double Engine::dual_violation(int j) const {
  const double tolerance = options.dual_tolerance + dual_rounding;
  switch (state[j]) {
    case VariableState::kAtLower:
      return d[j] < -tolerance ? -d[j] : 0;
    case VariableState::kAtUpper:
      return d[j] > tolerance ? d[j] : 0;
    case VariableState::kFree:
      return std::abs(d[j]) > tolerance ? std::abs(d[j]) : 0;
    case VariableState::kBasic:
      break;
  }
  return 0;
}

bool Engine::primal_feasible() const {
  for (int p = 0; p < model.rows; ++p) {
    if (infeasibility(p) != 0) return false;
  }
  return true;
}

void Engine::column(int j, double* z) {
  std::fill(row_work_.begin(), row_work_.end(), 0.0);
  for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
    row_work_[model.index[e]] = model.value[e];
  }
  factor.ftran_entering(row_work_.data(), z);
}

void Engine::inverse_row(int p, double* result) { factor.row(p, position_work_.data(), result); }

void Engine::refined_inverse_row(int row) {
  inverse_row(row, rho.data());
  for (int p = 0; p < model.rows; ++p) {
    double sum = p == row ? 1 : 0;
    for (int e = model.start[head[p]]; e < model.start[head[p] + 1]; ++e) {
      sum -= model.value[e] * rho[model.index[e]];
    }
    position_work_[p] = sum;
  }
  factor.btran(position_work_.data(), row_work_.data());
  for (int i = 0; i < model.rows; ++i) rho[i] += row_work_[i];
}

void Engine::tableau_row(const double* row) {
  if (model.sparse) return tableau_row_by_rows(row);
  for (int j = model.rows; j < model.total; ++j) {
    double sum = 0;
    if (state[j] != VariableState::kBasic && !model.fixed[j]) {
      for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
        sum += model.value[e] * row[model.index[e]];
      }
    }
    alpha_row[j] = sum;
  }
}

/// The same over the non-zero entries of `row` only.
void Engine::tableau_row_by_rows(const double* row) {
  const Lines& rows = model.by_rows;
  std::fill(alpha_row.begin(), alpha_row.end(), 0.0);
  for (int i = 0; i < model.rows; ++i) {
    const double y_i = row[i];
    if (y_i == 0) continue;
    for (int e = rows.start[i]; e < rows.start[i + 1]; ++e) {
      alpha_row[rows.index[e]] += y_i * rows.value[e];
    }
  }
  for (const int j : head) alpha_row[j] = 0;
}

void Engine::pivot(int p, int q, VariableState leaving_state, double entering_value) {
  factor.update(p, alpha_column.data());
  state[head[p]] = leaving_state;
  state[q] = VariableState::kBasic;
  head[p] = q;
  x_basic[p] = entering_value;
  load_position(p);
}

void Engine::load_position(int p) {
  const int j = head[p];
  basic_lower[p] = lower[j];
  basic_upper[p] = upper[j];
  const double bound = std::min(std::abs(lower[j]), std::abs(upper[j]));
  basic_tolerance[p] =
      options.primal_tolerance + (std::isfinite(bound) ? 1e-12 * bound : 0) + excused_[j];
}

/// The proof compares rho'b with the row's terms rho'a_j x_j; a violation below 1e-10 of them
/// proves nothing.
bool Engine::provable(double violation) const {
  double terms = 0;
  for (int i = 0; i < model.rows; ++i) terms += std::abs(rho[i] * model.b[i]);
  for (int j = 0; j < model.total; ++j) {
    if (state[j] == VariableState::kBasic) continue;
    double a = 0;
    for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
      a += model.value[e] * rho[model.index[e]];
    }
    const double l = std::isfinite(lower[j]) ? lower[j] : 0;
    const double u = std::isfinite(upper[j]) ? upper[j] : 0;
    terms += std::abs(a) * std::max(std::abs(l), std::abs(u));
  }
  return violation > 1e-10 * terms;
}

void Engine::excuse(int p, double violation) {
  excused_[head[p]] = 2 * violation;
  load_position(p);
}

}  // namespace maxwrench::simplex
