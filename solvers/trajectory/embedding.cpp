#include "solvers/trajectory/embedding.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

constexpr int kMaxIterations = 150;
/// Pivots of the normal equations below this share are rounding errors. Where steps end at once,
/// the limit rises tenfold each time.
constexpr double kPivot = 1e-15;
constexpr double kStuck = 1e-4;
constexpr int kPatience = 4;
/// The share of the way to the boundary that a step leaves: kLeft times the gap, within these
/// limits.
constexpr double kLeft = 0.3, kMostLeft = 0.01, kLeastLeft = 1e-5;
/// The gap is reduced to kClosed times the tolerance, so that values can be compared. If the
/// tolerance is kStepOnly or more, the answer is only used for a step, and the tolerance itself is
/// enough.
constexpr double kClosed = 0.1, kStepOnly = 1e-8;
/// A correction that lengthens the step by less than this share is undone, and no other follows.
constexpr double kLonger = 0.02;
constexpr int kCorrections = 2;
/// The initial slacks [N, N m]. Their products with their multipliers, all equal to mu, leave room
/// for programs that need much larger slacks.
constexpr double kSlack = 10;
/// Steps are refined if the gap is below this.
constexpr double kRefine = 1e-6;

}  // namespace

Embedding::End Embedding::run(const TrajectoryProgram& program, bool rates, bool slacks,
                              double tolerance, TrajectorySolution& solution) {
  forms_.build(program, rates, slacks);
  matrix_.reserve(forms_);
  start(program);
  int stuck = 0;
  double step = 0;
  for (int count = 0;; ++count, ++solution.iterations) {
    measure(step);
    if (settled(program, tolerance, solution)) return End::kVerdict;
    const bool ends = count == kMaxIterations || !(mu_ > 1e-20) || stuck > kPatience;
    const bool unbalanced = dual_value_ < 0 && kappa_ > tau_;
    if (!slacks && (ends || unbalanced)) return End::kNeedsSlacks;
    if (!rates && (ends || (kappa_ < tau_ && !forms_.keeps_rates(program, phi_, tau_)))) {
      return End::kNeedsRates;
    }
    if (ends) return End::kNone;
    iterate();
    step = std::min(1.0, (1 - left()) * reach());
    stuck = step < kStuck ? stuck + 1 : 0;
    if (stuck > 0) least_pivot_ *= 10;
  }
}

void Embedding::start(const TrajectoryProgram& program) {
  const int size = forms_.size;
  const auto slacks = static_cast<Eigen::Index>(forms_.slacks.size());
  G_.resize(size, 3);
  if (split()) G_low_.resize(size, 2);
  D_X_.resize(forms_.variables, 3);
  D_sigma_.resize(slacks, 2);
  weight_.resize(size);
  s_phi_.resize(slacks);
  s_diagonal_.resize(slacks);
  equation_y_.setZero(static_cast<Eigen::Index>(forms_.equations.size()));
  equation_dy_.resizeLike(equation_y_);
  rho_ = split() ? program.rho : 0;
  count_ = forms_.has_lo.sum() + forms_.has_hi.sum();
  const double mu = split() ? 0.5 * rho_ * kSlack : 30.0 / forms_.N;
  scale_ = forms_.scale;
  for (const Forms::Stage& at : forms_.stages) {
    if (at.has_t) scale_[at.f0 + at.count - 1] = 30;
  }
  low_.start(forms_.lo, forms_.has_lo, scale_, mu);
  high_.start(forms_.hi, forms_.has_hi, scale_, mu);
  X_.setZero(forms_.variables);
  phi_.setZero(size);
  sigma_.setConstant(slacks, kSlack);
  if (split()) phi_low_.setZero(size);
  for (const int f : forms_.slacks) {
    phi_[f] = -kSlack;
    phi_low_[f] = kSlack;
    low_.y[f] = high_.y[f] = 0.5 * rho_;
    low_.s[f] = high_.s[f] = kSlack;
  }
  tau_ = 1;
  kappa_ = mu;
  least_pivot_ = kPivot;
}

/// Whether the present point gives a verdict that the data confirm.
bool Embedding::settled(const TrajectoryProgram& program, double tolerance,
                        TrajectorySolution& solution) {
  if (!std::isfinite(mu_)) return false;
  const double size = tau_ + std::abs(primal_value_);
  const double gap = tolerance < kStepOnly ? kClosed * tolerance : tolerance;
  if (std::abs(dual_value_ - primal_value_) <= gap * size && kappa_ < tau_) {
    forms_.read_primal(program, X_, tau_, solution);
    collect_multipliers();
    forms_.read_dual(program, kept_G_, tau_, false, solution);
    solution.residual = recheck(program, solution);
    if (solution.residual.within(tolerance * (1 + std::abs(solution.value) + solution.price))) {
      solution.conclude(Status::kOptimal);
      return true;
    }
  }
  if (dual_value_ < 0 && kappa_ > tau_) {
    collect_multipliers();
    forms_.read_dual(program, kept_G_, -dual_value_, true, solution);
    if (proves_infeasible(program, solution)) {
      solution.conclude(Status::kInfeasible, "no efforts and wrenches balance all instants");
      return true;
    }
  }
  return false;
}

void Embedding::collect_multipliers() {
  kept_G_ = high_.y - low_.y;
  for (std::size_t e = 0; e < forms_.equations.size(); ++e) {
    kept_G_[forms_.equations[e]] = equation_y_[static_cast<Eigen::Index>(e)];
  }
}

void Embedding::iterate() {
  matrix_.factor(forms_, weight_, least_pivot_);
  predict();
  const double rest = 1 - std::min(1.0, reach());
  const double gamma = std::max(rest * rest * std::min(rest, 0.5), 1e-12);
  const double reduction = 1 - gamma;
  const double tau_centre = gamma * mu_ - tau_ * kappa_ - d_tau_ * d_kappa_;
  direct(reduction, tau_centre, gamma * mu_);
  if (forms_.p > 0) centralise(reduction, tau_centre);
  if (dual_value_ - primal_value_ < kRefine * (tau_ + std::abs(primal_value_))) refine(reduction);
}

/// Computes the directions of tau and of the predictor together.
void Embedding::predict() {
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    D_sigma_(i, kStep) = high_.y[f] + low_.y[f] - rho_ * tau_ +
                         high_.newton_rhs(1, phi_[f], tau_, f) +
                         low_.newton_rhs(1, phi_low_[f], tau_, f);
  }
  D_X_.col(kTau) = forms_.cost;
  D_X_.col(kStep).setZero();
  D_X_.col(kDual) = tau_ * forms_.cost;
  eliminate_slacks(kTau, 2);
  forms_.add_transposed(G_, D_X_);
  D_X_.col(kStep) += D_X_.col(kDual);
  solve_normal(kTau, 2);
  combine_directions(1, -tau_ * kappa_, affine_rhs());
  predict_affine();
}

/// Eliminates the columns of sigma from the right-hand sides.
void Embedding::eliminate_slacks(int first, int count) {
  for (int c = first; c < first + count; ++c) {
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      G_(forms_.slacks[i], c) -= s_phi_[i] / s_diagonal_[i] * D_sigma_(i, c);
    }
  }
}

/// Solves for columns of X and sigma from their right-hand sides, and maps them to G.
void Embedding::solve_normal(int first, int count) {
  auto X = D_X_.middleCols(first, count);
  auto G = G_.middleCols(first, count);
  matrix_.solve(forms_, X);
  forms_.apply(X, G);
  if (!split()) return;
  G_low_.middleCols(first, count) = G;
  for (int c = first; c < first + count; ++c) {
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      const int f = forms_.slacks[i];
      double& sigma = D_sigma_(i, c);
      sigma = (sigma - s_phi_[i] * G_(f, c)) / s_diagonal_[i];
      G_(f, c) -= sigma;
      G_low_(f, c) += sigma;
    }
  }
}

/// The direction for the present centres, raised by `raise`. `reduction` is the share of the
/// residuals that it removes.
void Embedding::direct(double reduction, double tau_centre, double raise) {
  const double rhs = newton_rhs(reduction, raise);
  D_X_.col(kStep) = reduction * D_X_.col(kDual);
  eliminate_slacks(kStep, 1);
  forms_.add_transposed(G_.col(kStep), D_X_.col(kStep));
  solve_normal(kStep, 1);
  combine_directions(reduction, tau_centre, rhs);
  finish(reduction);
}

/// Computes d tau and d kappa. By symmetry of H, the change of the limits by the step along the
/// direction of tau could be computed as (c, -rho)'(X, sigma) of the step; but that loses too much
/// to rounding for slacks, whose weights differ most.
void Embedding::combine_directions(double reduction, double tau_centre, double rhs) {
  double dual = D_X_.col(kTau).dot(D_X_.col(kDual));
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    dual += D_sigma_(i, kTau) * (high_.y[f] + low_.y[f] - rho_ * tau_);
  }
  const double along = forms_.cost.dot(D_X_.col(kStep)) - rho_ * D_sigma_.col(kStep).sum();
  const double right = reduction * (gap_residual_ + dual) + tau_centre / tau_ + rhs - along +
                       (split() ? sum_moves() : -along);
  d_tau_ = right / tau_pivot_;
  d_kappa_ = (tau_centre - kappa_ * d_tau_) / tau_;
}

/// Gondzio's corrections: products that would be far from mu after a longer step are moved back
/// towards it. A correction that does not lengthen the step is undone.
void Embedding::centralise(double reduction, double tau_centre) {
  double step = reach();
  for (int count = 0; count < kCorrections && step < 0.9; ++count) {
    const double trial = std::min(1.0, step + 0.2);
    const double mu = (1 - trial * reduction) * mu_;
    for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
      high_.center_products<L>(trial, mu, i);
      low_.center_products<L>(trial, mu, i);
    });
    direct(reduction, tau_centre, 0);
    const double longer = reach();
    if (longer < step + kLonger) {
      high_.centre -= high_.correction;
      low_.centre -= low_.correction;
      direct(reduction, tau_centre, 0);
      return;
    }
    step = longer;
  }
}

/// Removes from the steps of the multipliers the error A'dy that rounding left in the normal
/// equations.
void Embedding::refine(double reduction) {
  kept_X_ = D_X_.col(kStep);
  kept_G_ = G_.col(kStep);
  kept_sigma_ = D_sigma_.col(kStep);
  if (split()) kept_low_ = G_low_.col(kStep);
  D_X_.col(kStep) = reduction * D_X_.col(kDual) + d_tau_ * forms_.cost;
  G_.col(kStep) = low_.dy - high_.dy;
  for (std::size_t e = 0; e < forms_.equations.size(); ++e) {
    G_(forms_.equations[e], kStep) = -equation_dy_[static_cast<Eigen::Index>(e)];
  }
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    D_sigma_(i, kStep) = reduction * (high_.y[f] + low_.y[f] - rho_ * tau_) - d_tau_ * rho_ +
                         high_.dy[f] + low_.dy[f];
  }
  eliminate_slacks(kStep, 1);
  forms_.add_transposed(G_.col(kStep), D_X_.col(kStep));
  solve_normal(kStep, 1);
  add_change();
  D_X_.col(kStep) += kept_X_;
  G_.col(kStep) += kept_G_;
  D_sigma_.col(kStep) += kept_sigma_;
  if (split()) G_low_.col(kStep) += kept_low_;
}

/// The share of the way to the boundary that the step leaves; it decreases as the gap closes.
double Embedding::left() const {
  const double gap = std::abs(dual_value_ - primal_value_) / (tau_ + std::abs(primal_value_));
  return std::clamp(kLeft * gap, kLeastLeft, kMostLeft);
}

/// The longest step up to 1,000 that keeps s, y, tau and kappa positive.
double Embedding::reach() const {
  return 1 / std::max({1e-3, -d_tau_ / tau_, -d_kappa_ / kappa_, falls_});
}

const char* Embedding::reason() const {
  if (primal_value_ > 0 && kappa_ > tau_) return "the value seems to grow without limit";
  return "the interior point method ends without a verdict that the data confirm";
}

}  // namespace maxwrench
