#include <algorithm>
#include <cmath>

#include "solvers/lp/simplex/engine.h"

namespace maxwrench::simplex {

/// The primal simplex: starts from a feasible basis and improves the objective.
///
/// Entering column by Devex weights, leaving row by Harris' ratio test in two passes: the longest
/// step that violates no bound by more than the tolerance, then the largest pivot that blocks
/// within it. A bound that is already violated there is shifted to the present value.
class Primal {
 public:
  explicit Primal(Engine& engine) : e(engine), s(engine.options) {}
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

  Engine& e;
  const SimplexOptions& s;
  int r_ = -1;
  double direction_ = 0, theta_ = 0;
  int stalled_ = 0;
  bool perturbed_ = false, bland_ = false;
};

Outcome Engine::primal() { return Primal(*this).run(); }

Outcome Primal::run() {
  std::fill(e.weights_.begin(), e.weights_.end(), 1.0);
  for (;;) {
    if (e.factor.updates() == s.max_updates && !refresh()) return Outcome::kTrouble;
    if (e.iterations >= e.iteration_limit) return Outcome::kIterationLimit;
    const int q = choose_column();
    if (q < 0) return Outcome::kDone;
    direction_ = e.d[q] < 0 ? 1 : -1;
    e.column(q, e.alpha_column.data());
    choose_row(q);
    if (r_ < 0 && theta_ == kInfinity) {
      if (e.factor.updates() == 0) {
        e.proof_column = q;
        e.proof_sign = direction_;
        return Outcome::kUnbounded;
      }
      if (!refresh()) return Outcome::kTrouble;
      continue;
    }
    if (r_ < 0) {
      flip(q);
      continue;
    }
    if (std::abs(e.alpha_column[r_]) < s.pivot_tolerance && e.factor.updates() > 0) {
      if (!refresh()) return Outcome::kTrouble;
      continue;
    }
    step(q);
  }
}

/// Fresh factors, x and d. A basis that had to be repaired or is clearly infeasible ends the phase.
bool Primal::refresh() {
  if (!e.refactor()) return false;
  e.compute_primal();
  e.compute_dual();
  for (int p = 0; p < e.model.rows; ++p) {
    if (std::abs(e.infeasibility(p)) > 100 * (e.basic_tolerance[p] + e.rounding)) return false;
  }
  return true;
}

int Primal::choose_column() const {
  int best = -1;
  double best_score = 0;
  for (int j = e.model.rows; j < e.model.total; ++j) {
    if (e.state[j] == VariableState::kBasic || e.model.fixed[j]) continue;
    const double v = e.dual_violation(j);
    if (v == 0) continue;
    if (bland_) return j;
    const double score = v * v / e.weights_[j];
    if (score > best_score) best_score = score, best = j;
  }
  return best;
}

/// Room of the basic variable at p when the entering one moves with tableau entry `a`.
double Primal::slack(int p, double a) const {
  return a > 0 ? e.x_basic[p] - e.basic_lower[p] : e.basic_upper[p] - e.x_basic[p];
}

void Primal::choose_row(int q) {
  r_ = -1;
  theta_ = e.upper[q] - e.lower[q];
  if (bland_) return choose_row_by_index();
  double longest = kInfinity;
  int first = -1;
  for (int p = 0; p < e.model.rows; ++p) {
    const double a = direction_ * e.alpha_column[p];
    if (std::abs(a) <= s.zero_tolerance) continue;
    const double room = slack(p, a);
    if (room == kInfinity) continue;
    const double reach = (std::max(room, 0.0) + s.primal_tolerance) / std::abs(a);
    if (reach < longest) longest = reach, first = p;
  }
  if (theta_ <= longest) return;
  double best = 0;
  for (int p = 0; p < e.model.rows; ++p) {
    const double a = direction_ * e.alpha_column[p];
    if (std::abs(a) <= std::max(s.zero_tolerance, best)) continue;
    const double room = slack(p, a);
    if (room > longest * std::abs(a) && p != first) continue;
    best = std::abs(a);
    r_ = p;
    theta_ = std::max(room, 0.0) / best;
  }
}

void Primal::choose_row_by_index() {
  for (int p = 0; p < e.model.rows; ++p) {
    const double a = direction_ * e.alpha_column[p];
    if (std::abs(a) <= s.zero_tolerance) continue;
    const double ratio = std::max(slack(p, a), 0.0) / std::abs(a);
    if (ratio < theta_ || (ratio == theta_ && r_ >= 0 && e.head[p] < e.head[r_])) {
      theta_ = ratio;
      r_ = p;
    }
  }
}

void Primal::move(double theta) {
  if (theta == 0) return;
  const double step = direction_ * theta;
  for (int p = 0; p < e.model.rows; ++p) e.x_basic[p] -= step * e.alpha_column[p];
}

void Primal::flip(int q) {
  ++e.iterations;
  move(theta_);
  e.state[q] = direction_ > 0 ? VariableState::kAtUpper : VariableState::kAtLower;
  note_progress(theta_);
}

void Primal::step(int q) {
  ++e.iterations;
  const bool to_lower = direction_ * e.alpha_column[r_] > 0;
  const int leaving = e.head[r_];
  const double room = slack(r_, direction_ * e.alpha_column[r_]);
  if (room < 0) {
    (to_lower ? e.lower[leaving] : e.upper[leaving]) = e.x_basic[r_];
    e.bounds_shifted = true;
  }
  update_duals(q, e.alpha_column[r_]);
  const double entering = e.nonbasic_value(q) + direction_ * theta_;
  move(theta_);
  e.pivot(r_, q, to_lower ? VariableState::kAtLower : VariableState::kAtUpper, entering);
  note_progress(theta_);
}

/// d -= (d_q / pivot) alpha_r, and the Devex weights that use the same row.
void Primal::update_duals(int q, double pivot) {
  e.inverse_row(r_, e.rho.data());
  e.tableau_row(e.rho.data());
  const double theta = e.d[q] / pivot, reference = e.weights_[q];
  const int leaving = e.head[r_];
  for (int j = e.model.rows; j < e.model.total; ++j) {
    const double a = e.alpha_row[j];
    if (a == 0 || j == q) continue;
    e.d[j] -= theta * a;
    const double ratio = a / pivot;
    e.weights_[j] = std::max(e.weights_[j], ratio * ratio * reference);
  }
  e.d[q] = 0;
  e.d[leaving] = -theta;
  e.weights_[leaving] = std::max(reference / (pivot * pivot), 1.0);
}

/// As in the dual phase, with bounds in the place of costs.
void Primal::note_progress(double theta) {
  if (theta > 1e-12) {
    stalled_ = 0;
    bland_ = false;
    return;
  }
  ++stalled_;
  if (!perturbed_ && e.perturb && stalled_ > 20 + e.model.rows / 10) perturb();
  if (stalled_ > 300 + 5 * e.model.rows) bland_ = true;
}

void Primal::perturb() {
  perturbed_ = true;
  e.bounds_shifted = true;
  for (int p = 0; p < e.model.rows; ++p) {
    const int j = e.head[p];
    const double size = 1e-6 * (1 + std::abs(e.x_basic[p]));
    e.basic_lower[p] = e.lower[j] -= size * e.jitter(j);
    e.basic_upper[p] = e.upper[j] += size * e.jitter(j);
  }
}

}  // namespace maxwrench::simplex
