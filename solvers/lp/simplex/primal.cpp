#include <algorithm>
#include <cmath>

#include "maxwrench/interruption.h"
#include "solvers/lp/simplex/engine.h"

namespace maxwrench::simplex {
namespace {

/// A larger Devex weight starts a new reference framework.
constexpr double kLargestWeight = 1e7;

}  // namespace

/// The primal simplex: starts from a feasible basis and improves the objective.
///
/// The entering column is chosen by Devex weights, the leaving row by Harris' ratio test in two
/// passes. The first pass finds the longest step that violates no bound by more than the tolerance,
/// the second the largest pivot that blocks within this step. If the bound at this pivot is already
/// violated, it is shifted to the present value.
class Primal {
 public:
  explicit Primal(Engine& engine) : e_(engine), s_(engine.options) {}
  Outcome run();

 private:
  bool refresh();
  int choose_column() const;
  void choose_row(int q);
  void choose_row_by_index();
  double slack(int p, double a) const;
  void move(double theta);
  void flip(int q);
  void step(int q);
  void update_duals(int q, double pivot);
  void note_progress(double theta);
  void perturb();

  Engine& e_;
  const SimplexOptions& s_;
  int r_ = -1;
  double direction_ = 0, theta_ = 0;
  int stalled_ = 0;
  bool perturbed_ = false, bland_ = false;
};

Outcome Engine::primal() { return Primal(*this).run(); }

Outcome Primal::run() {
  std::fill(e_.weights_.begin(), e_.weights_.end(), 1.0);
  for (;;) {
    if (e_.factor.updates() == s_.max_updates && !refresh()) return Outcome::kTrouble;
    end_if_interrupted();
    if (e_.iterations >= e_.iteration_limit) return Outcome::kIterationLimit;
    const int q = choose_column();
    if (q < 0) return Outcome::kDone;
    direction_ = e_.d[q] < 0 ? 1 : -1;
    e_.column(q, e_.alpha_column.data());
    choose_row(q);
    if (r_ < 0 && theta_ == kInfinity) {
      if (e_.factor.updates() == 0) {
        e_.proof_column = q;
        e_.proof_sign = direction_;
        return Outcome::kUnbounded;
      }
      if (!refresh()) return Outcome::kTrouble;
      continue;
    }
    if (r_ < 0) {
      flip(q);
      continue;
    }
    if (std::abs(e_.alpha_column[r_]) < s_.pivot_tolerance && e_.factor.updates() > 0) {
      if (!refresh()) return Outcome::kTrouble;
      continue;
    }
    step(q);
  }
}

/// Computes fresh factors, x and d. Ends the phase if the basis had to be repaired or is clearly
/// infeasible.
bool Primal::refresh() {
  if (!e_.refactor()) return false;
  e_.compute_primal();
  e_.compute_dual();
  for (int p = 0; p < e_.model.rows; ++p) {
    if (std::abs(e_.infeasibility(p)) > 100 * (e_.basic_tolerance[p] + e_.rounding)) return false;
  }
  return true;
}

int Primal::choose_column() const {
  int best = -1;
  double best_score = 0;
  for (int j = e_.model.rows; j < e_.model.total; ++j) {
    if (e_.state[j] == VariableState::kBasic || e_.model.fixed[j]) continue;
    const double v = e_.dual_violation(j);
    if (v == 0) continue;
    if (bland_) return j;
    const double score = v * v / e_.weights_[j];
    if (score > best_score) best_score = score, best = j;
  }
  return best;
}

/// The distance that the basic variable at p permits, when the entering variable moves with tableau
/// entry `a`.
double Primal::slack(int p, double a) const {
  return a > 0 ? e_.x_basic[p] - e_.basic_lower[p] : e_.basic_upper[p] - e_.x_basic[p];
}

void Primal::choose_row(int q) {
  r_ = -1;
  theta_ = e_.upper[q] - e_.lower[q];
  if (bland_) return choose_row_by_index();
  double longest = kInfinity;
  int first = -1;
  for (int p = 0; p < e_.model.rows; ++p) {
    const double a = direction_ * e_.alpha_column[p];
    if (std::abs(a) <= s_.zero_tolerance) continue;
    const double room = slack(p, a);
    if (room == kInfinity) continue;
    const double reach = (std::max(room, 0.0) + s_.primal_tolerance) / std::abs(a);
    if (reach < longest) longest = reach, first = p;
  }
  if (theta_ <= longest) return;
  double best = 0;
  for (int p = 0; p < e_.model.rows; ++p) {
    const double a = direction_ * e_.alpha_column[p];
    if (std::abs(a) <= std::max(s_.zero_tolerance, best)) continue;
    const double room = slack(p, a);
    if (room > longest * std::abs(a) && p != first) continue;
    best = std::abs(a);
    r_ = p;
    theta_ = std::max(room, 0.0) / best;
  }
}

void Primal::choose_row_by_index() {
  for (int p = 0; p < e_.model.rows; ++p) {
    const double a = direction_ * e_.alpha_column[p];
    if (std::abs(a) <= s_.zero_tolerance) continue;
    const double ratio = std::max(slack(p, a), 0.0) / std::abs(a);
    if (ratio < theta_ || (ratio == theta_ && r_ >= 0 && e_.head[p] < e_.head[r_])) {
      theta_ = ratio;
      r_ = p;
    }
  }
}

void Primal::move(double theta) {
  if (theta == 0) return;
  const double step = direction_ * theta;
  for (int p = 0; p < e_.model.rows; ++p) e_.x_basic[p] -= step * e_.alpha_column[p];
}

void Primal::flip(int q) {
  ++e_.iterations;
  move(theta_);
  e_.state[q] = direction_ > 0 ? VariableState::kAtUpper : VariableState::kAtLower;
  note_progress(theta_);
}

void Primal::step(int q) {
  ++e_.iterations;
  const bool to_lower = direction_ * e_.alpha_column[r_] > 0;
  const int leaving = e_.head[r_];
  const double room = slack(r_, direction_ * e_.alpha_column[r_]);
  if (room < 0) {
    (to_lower ? e_.lower[leaving] : e_.upper[leaving]) = e_.x_basic[r_];
    e_.bounds_shifted = true;
  }
  update_duals(q, e_.alpha_column[r_]);
  const double entering = e_.nonbasic_value(q) + direction_ * theta_;
  move(theta_);
  e_.pivot(r_, q, to_lower ? VariableState::kAtLower : VariableState::kAtUpper, entering);
  note_progress(theta_);
}

/// d -= (d_q / pivot) alpha_r, and the Devex weights that use the same row.
void Primal::update_duals(int q, double pivot) {
  e_.inverse_row(r_, e_.rho.data());
  e_.tableau_row(e_.rho.data());
  const double theta = e_.d[q] / pivot, reference = e_.weights_[q];
  const int leaving = e_.head[r_];
  for (int j = e_.model.rows; j < e_.model.total; ++j) {
    const double a = e_.alpha_row[j];
    if (a == 0 || j == q) continue;
    e_.d[j] -= theta * a;
    const double ratio = a / pivot;
    e_.weights_[j] = std::max(e_.weights_[j], ratio * ratio * reference);
  }
  // After thousands of pivots, weights grow until they overflow and hide every violation.
  if (reference > kLargestWeight) {
    std::fill(e_.weights_.begin(), e_.weights_.end(), 1.0);
  }
  e_.d[q] = 0;
  e_.d[leaving] = -theta;
  e_.weights_[leaving] = std::max(reference / (pivot * pivot), 1.0);
}

/// Like in the dual phase, with bounds instead of costs.
void Primal::note_progress(double theta) {
  if (theta > 1e-12) {
    stalled_ = 0;
    bland_ = false;
    return;
  }
  ++stalled_;
  if (!perturbed_ && e_.perturb && stalled_ > 20 + e_.model.rows / 10) perturb();
  if (stalled_ > 300 + 5 * e_.model.rows) bland_ = true;
}

void Primal::perturb() {
  perturbed_ = true;
  e_.bounds_shifted = true;
  for (int p = 0; p < e_.model.rows; ++p) {
    const int j = e_.head[p];
    const double size = 1e-6 * (1 + std::abs(e_.x_basic[p]));
    e_.basic_lower[p] = e_.lower[j] -= size * e_.jitter(j);
    e_.basic_upper[p] = e_.upper[j] += size * e_.jitter(j);
  }
}

}  // namespace maxwrench::simplex
