#include <algorithm>
#include <cmath>

#include "maxwrench/interruption.h"
#include "solvers/lp/simplex/engine.h"

namespace maxwrench::simplex {
namespace {

/// Up to this number of rows, steepest edge weights cost more than the pivots that they save.
constexpr int kPlainPricing = 24;

}  // namespace

/// The dual simplex: starts from reduced costs of the right sign and removes bound violations.
///
/// The leaving row is chosen by steepest edge, or in small programs by the largest violation. The
/// entering column is chosen by the bound flipping ratio test: as the dual step grows, candidates
/// whose reduced cost changes sign jump to their other bound while some of the row's violation
/// remains. Among the breakpoints that are within the dual tolerance of each other (Harris), the
/// one with the largest pivot enters. A reduced cost that then has the wrong sign is moved to zero
/// by shifting its cost.
class Dual {
 public:
  explicit Dual(Engine& engine) : e_(engine), s_(engine.options) {}
  Outcome run();

 private:
  bool refresh();
  void make_dual_feasible(bool may_flip);
  int choose_row() const;
  void gather_candidates();
  int choose_column();
  int choose_column_by_index();
  int largest_pivot_of_groups();
  bool pivots_agree(double by_column, double by_row) const;
  void flip();
  void step(int q);
  void update_duals(double theta);
  void update_weights(double pivot);
  void note_progress(double theta);
  void perturb();

  Engine& e_;
  const SimplexOptions& s_;
  int r_ = -1;       // leaving position
  double sign_ = 0;  // +1: x_r above its upper bound
  double violation_ = 0;
  double left_over_ = 0;  // violation that remains after all candidates have jumped
  int stalled_ = 0;
  bool perturbed_ = false, bland_ = false;
};

Outcome Engine::dual() { return Dual(*this).run(); }

Outcome Dual::run() {
  std::fill(e_.weights_.begin(), e_.weights_.begin() + e_.model.rows, 1.0);
  make_dual_feasible(true);
  for (;;) {
    if (e_.factor.updates() == s_.max_updates && !refresh()) return Outcome::kTrouble;
    end_if_interrupted();
    if (e_.iterations >= e_.iteration_limit) return Outcome::kIterationLimit;
    r_ = choose_row();
    if (r_ < 0) return Outcome::kDone;
    const double infeasibility = e_.infeasibility(r_);
    sign_ = infeasibility > 0 ? 1 : -1;
    violation_ = std::abs(infeasibility);
    e_.inverse_row(r_, e_.rho.data());
    e_.tableau_row(e_.rho.data());
    gather_candidates();
    int q = bland_ ? choose_column_by_index() : choose_column();
    if (q < 0 && e_.factor.updates() > 0) {
      if (!refresh()) return Outcome::kTrouble;
      continue;
    }
    if (q < 0) {
      if (e_.provable(left_over_)) {
        e_.proof_position = r_;
        e_.proof_sign = sign_;
        return Outcome::kInfeasible;
      }
      if (e_.candidates_.empty()) {
        e_.excuse(r_, violation_);
        continue;
      }
      q = largest_pivot_of_groups();
      if (q < 0) return Outcome::kTrouble;
    }
    e_.column(q, e_.alpha_column.data());
    if (!pivots_agree(e_.alpha_column[r_], e_.alpha_row[q])) {
      if (e_.factor.updates() == 0 || !refresh()) return Outcome::kTrouble;
      continue;
    }
    step(q);
  }
}

/// Computes fresh factors, x and d. Ends the phase if the basis had to be repaired.
bool Dual::refresh() {
  if (!e_.refactor()) return false;
  e_.compute_primal();
  e_.compute_dual();
  make_dual_feasible(false);
  return true;
}

/// Moves boxed variables to the bound that fits the sign of d; shifts other costs so that their
/// reduced cost is small and has the right sign. During the phase it only shifts costs, because the
/// phase would have to repeat what a flip undoes.
void Dual::make_dual_feasible(bool may_flip) {
  bool moved = false;
  for (int j = e_.model.rows; j < e_.model.total; ++j) {
    if (e_.model.fixed[j] || e_.dual_violation(j) == 0) continue;
    if (!may_flip) {
      e_.cost[j] -= e_.d[j];
      e_.d[j] = 0;
    } else if (e_.state[j] == VariableState::kAtLower && std::isfinite(e_.upper[j])) {
      e_.state[j] = VariableState::kAtUpper;
      moved = true;
    } else if (e_.state[j] == VariableState::kAtUpper && std::isfinite(e_.lower[j])) {
      e_.state[j] = VariableState::kAtLower;
      moved = true;
    } else {
      double target = 0;
      if (e_.perturb && e_.state[j] != VariableState::kFree) {
        target = (e_.state[j] == VariableState::kAtLower ? 1e-3 : -1e-3) * e_.jitter(j);
      }
      e_.cost[j] += target - e_.d[j];
      e_.d[j] = target;
    }
  }
  if (moved) e_.compute_primal();
}

int Dual::choose_row() const {
  int best = -1;
  double best_score = 0;
  for (int p = 0; p < e_.model.rows; ++p) {
    const double v = e_.infeasibility(p);
    if (v == 0) continue;
    if (bland_) {
      if (best < 0 || e_.head[p] < e_.head[best]) best = p;
      continue;
    }
    const double score = v * v / e_.weights_[p];
    if (score > best_score) best_score = score, best = p;
  }
  return best;
}

/// Gathers the nonbasic variables that reduce the violation when they move towards their other
/// bound.
void Dual::gather_candidates() {
  e_.candidates_.clear();
  for (int j = e_.model.rows; j < e_.model.total; ++j) {
    const double a = sign_ * e_.alpha_row[j];
    if (std::abs(a) <= s_.zero_tolerance) continue;
    const bool fits =
        e_.state[j] == VariableState::kFree ||
        (a > 0 ? e_.state[j] == VariableState::kAtLower : e_.state[j] == VariableState::kAtUpper);
    if (!fits) continue;
    e_.ratios_[j] = std::max(0.0, a > 0 ? e_.d[j] : -e_.d[j]);
    if (e_.state[j] == VariableState::kFree) e_.ratios_[j] = 0;
    e_.candidates_.push_back(j);
  }
}

int Dual::choose_column_by_index() {
  e_.flipped_.clear();
  left_over_ = violation_;
  int best = -1;
  double best_ratio = kInfinity;
  for (const int j : e_.candidates_) {
    const double ratio = e_.ratios_[j] / std::abs(e_.alpha_row[j]);
    if (ratio < best_ratio) best_ratio = ratio, best = j;
  }
  return best;
}

/// Splits the candidates into groups of neighbouring breakpoints, in the order of the dual step,
/// until the violation is used up. Returns -1 if some violation remains after all of them.
int Dual::choose_column() {
  auto& list = e_.candidates_;
  e_.flipped_.clear();
  e_.groups_.clear();
  e_.groups_.push_back(0);
  const int count = static_cast<int>(list.size());
  double slope = violation_;
  int done = 0;
  while (done < count) {
    double step = kInfinity;
    int first = -1;
    for (int k = done; k < count; ++k) {
      const int j = list[k];
      const double reach = (e_.ratios_[j] + s_.dual_tolerance) / std::abs(e_.alpha_row[j]);
      if (reach < step) step = reach, first = j;
    }
    left_over_ = slope;
    if (first < 0) return -1;  // not a number
    const int begin = done;
    for (int k = begin; k < count; ++k) {
      const int j = list[k];
      const double a = std::abs(e_.alpha_row[j]);
      if (e_.ratios_[j] > step * a && j != first) continue;
      std::swap(list[k], list[done++]);
      slope -= a * (e_.upper[j] - e_.lower[j]);
    }
    e_.groups_.push_back(done);
    if (slope <= s_.primal_tolerance) return largest_pivot_of_groups();
  }
  left_over_ = slope;
  return -1;
}

/// Chooses from the last group, which has the longest step, unless its pivots are small and an
/// earlier group has a better one. All groups before the chosen one jump.
int Dual::largest_pivot_of_groups() {
  const auto& list = e_.candidates_;
  double largest = 0;
  for (int k = 0; k < e_.groups_.back(); ++k) {
    largest = std::max(largest, std::abs(e_.alpha_row[list[k]]));
  }
  const double acceptable = std::min(0.1 * largest, 1.0) * 0.1;
  int best = -1, chosen = 0;
  double best_pivot = 0;
  for (int g = static_cast<int>(e_.groups_.size()) - 2; g >= 0; --g) {
    int local = -1;
    double pivot = 0;
    for (int k = e_.groups_[g]; k < e_.groups_[g + 1]; ++k) {
      const double a = std::abs(e_.alpha_row[list[k]]);
      if (a > pivot) pivot = a, local = list[k];
    }
    if (pivot > best_pivot) best_pivot = pivot, best = local, chosen = g;
    if (best_pivot >= acceptable) break;
  }
  e_.flipped_.assign(list.begin(), list.begin() + e_.groups_[chosen]);
  return best;
}

bool Dual::pivots_agree(double by_column, double by_row) const {
  if (std::abs(by_column) <= s_.zero_tolerance) return false;
  if (e_.factor.updates() == 0) return by_column * by_row > 0;
  return std::abs(by_column) >= s_.pivot_tolerance &&
         std::abs(by_column - by_row) <= 1e-7 * (1 + std::abs(by_column));
}

void Dual::flip() {
  if (e_.flipped_.empty()) return;
  std::fill(e_.row_work_.begin(), e_.row_work_.end(), 0.0);
  for (const int j : e_.flipped_) {
    const bool up = e_.state[j] == VariableState::kAtLower;
    e_.state[j] = up ? VariableState::kAtUpper : VariableState::kAtLower;
    const double change = up ? e_.upper[j] - e_.lower[j] : e_.lower[j] - e_.upper[j];
    for (int k = e_.model.start[j]; k < e_.model.start[j + 1]; ++k) {
      e_.row_work_[e_.model.index[k]] += change * e_.model.value[k];
    }
  }
  e_.factor.ftran(e_.row_work_.data(), e_.position_work_.data());
  for (int p = 0; p < e_.model.rows; ++p) e_.x_basic[p] -= e_.position_work_[p];
}

void Dual::step(int q) {
  ++e_.iterations;
  flip();
  const double pivot = e_.alpha_column[r_];
  const double theta_dual = e_.d[q] / e_.alpha_row[q];
  const double bound = sign_ > 0 ? e_.basic_upper[r_] : e_.basic_lower[r_];
  const double theta_primal = (e_.x_basic[r_] - bound) / pivot;
  update_duals(theta_dual);
  update_weights(pivot);
  const double entering = e_.nonbasic_value(q) + theta_primal;
  for (int p = 0; p < e_.model.rows; ++p) e_.x_basic[p] -= theta_primal * e_.alpha_column[p];
  const int leaving = e_.head[r_];
  e_.pivot(r_, q, sign_ > 0 ? VariableState::kAtUpper : VariableState::kAtLower, entering);
  e_.d[q] = 0;
  e_.d[leaving] = -theta_dual;
  note_progress(theta_dual);
}

/// d -= theta alpha_r. A reduced cost that Harris' tolerance left with the wrong sign is shifted to
/// zero.
void Dual::update_duals(double theta) {
  const bool upwards = sign_ * theta >= 0;
  for (int j = e_.model.rows; j < e_.model.total; ++j) {
    const double a = e_.alpha_row[j];
    if (a == 0) continue;
    if (upwards) e_.d[j] -= theta * a;
    const bool wrong = (e_.state[j] == VariableState::kAtLower && e_.d[j] < 0) ||
                       (e_.state[j] == VariableState::kAtUpper && e_.d[j] > 0);
    if (!wrong) continue;
    e_.cost[j] -= e_.d[j];
    e_.d[j] = 0;
  }
}

void Dual::update_weights(double pivot) {
  if (e_.model.rows <= kPlainPricing) return;
  double norm = 0;
  for (const double v : e_.rho) norm += v * v;
  std::copy(e_.rho.begin(), e_.rho.end(), e_.row_work_.begin());
  e_.factor.ftran(e_.row_work_.data(), e_.position_work_.data());
  for (int p = 0; p < e_.model.rows; ++p) {
    const double k = e_.alpha_column[p] / pivot;
    if (k == 0) continue;
    const double updated = e_.weights_[p] - 2 * k * e_.position_work_[p] + k * k * norm;
    e_.weights_[p] = std::max(updated, 1e-4 + k * k * 1e-4);
  }
  e_.weights_[r_] = std::max(norm / (pivot * pivot), 1e-4);
}

/// Counts steps of length zero, which may cycle. The first remedy is to perturb costs; the second
/// is to pivot by smallest indices, which ends in finitely many steps.
void Dual::note_progress(double theta) {
  if (std::abs(theta) > 1e-12) {
    stalled_ = 0;
    bland_ = false;
    return;
  }
  ++stalled_;
  if (!perturbed_ && e_.perturb && stalled_ > 20 + e_.model.rows / 10) perturb();
  if (stalled_ > 300 + 5 * e_.model.rows) bland_ = true;
}

void Dual::perturb() {
  perturbed_ = true;
  for (int j = e_.model.rows; j < e_.model.total; ++j) {
    if (e_.state[j] == VariableState::kBasic || e_.model.fixed[j]) continue;
    if (e_.state[j] == VariableState::kFree) continue;
    const double size = 1e-6 * (1 + std::abs(e_.cost[j])) * e_.jitter(j);
    const double change = e_.state[j] == VariableState::kAtLower ? size : -size;
    e_.cost[j] += change;
    e_.d[j] += change;
  }
}

}  // namespace maxwrench::simplex
