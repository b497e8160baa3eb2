#include "solvers/plan/embedding.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

constexpr int kMaxIterations = 150;
/// An equation's weight in the normal equations; what this leaves of it vanishes with the steps.
constexpr double kEquation = 1e8;
/// Pivots of the normal equations below this share are rounding. Where steps end at once, more is:
/// the limit rises tenfold each time.
constexpr double kPivot = 1e-15;
constexpr double kStuck = 1e-4;
constexpr int kPatience = 4;
/// The share of the way to the boundary that a step goes.
constexpr double kBoundary = 0.99;
/// A correction that does not lengthen the step by so much is the last.
constexpr double kLonger = 0.02;
constexpr int kCorrections = 2;

/// Columns of the directions.
constexpr int kTau = 0, kStep = 1, kDual = 2;

}  // namespace

Embedding::End Embedding::run(const PlanProgram& program, bool rates, bool slacks, double tolerance,
                              PlanSolution& solution) {
  forms_.build(program, rates, slacks);
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
    step = std::min(1.0, kBoundary * reach());
    stuck = step < kStuck ? stuck + 1 : 0;
    if (stuck > 0) least_pivot_ *= 10;
  }
}

void Embedding::start(const PlanProgram& program) {
  const int size = forms_.size;
  const auto slacks = static_cast<Eigen::Index>(forms_.slacks.size());
  D_.reserve(forms_, 3);
  rho_ = split() ? program.rho : 0;
  count_ = forms_.has_lo.sum() + forms_.has_hi.sum();
  const double mu = 30.0 / forms_.N;
  scale_ = forms_.scale;
  for (int i = 0; forms_.t > 0 && i < forms_.N; ++i) {
    scale_[forms_.stages[i].f0 + forms_.stages[i].count - 1] = 30;
  }
  low_.start(forms_.lo, forms_.has_lo, scale_, mu);
  high_.start(forms_.hi, forms_.has_hi, scale_, mu);
  X_.setZero(forms_.variables);
  phi_.setZero(size);
  sigma_.setOnes(slacks);
  if (split()) phi_low_.setZero(size);
  for (const int f : forms_.slacks) {
    phi_[f] = -1;
    phi_low_[f] = 1;
    low_.y[f] = high_.y[f] = 0.5 * rho_;
    low_.s[f] = high_.s[f] = 1;
  }
  tau_ = 1;
  kappa_ = mu;
  least_pivot_ = kPivot;
}

/// Takes the step; residuals of the embedding and right-hand sides at the point where it ends.
void Embedding::measure(double step) {
  if (step > 0) {
    X_ += step * (D_.X.col(kStep) + d_tau_ * D_.X.col(kTau));
    sigma_ += step * (D_.sigma.col(kStep) + d_tau_ * D_.sigma.col(kTau));
    tau_ += step * d_tau_;
    kappa_ += step * d_kappa_;
  }
  dual_value_ = 0;
  double complementarity = 0;
  const auto side = [&](Side& each, Eigen::VectorXd& phi, const Eigen::MatrixXd& G, bool own,
                        Eigen::Index a, Eigen::Index n) {
    if (step > 0) {
      if (own) phi.segment(a, n) += step * (G.col(kStep) + d_tau_ * G.col(kTau)).segment(a, n);
      each.advance(step, a, n);
    }
    each.measure(phi, tau_, a, n);
    dual_value_ += each.sign * each.limit->segment(a, n).dot(each.y.segment(a, n));
    complementarity -= each.centre.segment(a, n).sum();
  };
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    side(high_, phi_, D_.G, true, a, n);
    side(low_, split() ? phi_low_ : phi_, D_.low(), split(), a, n);
    const auto theta_h = high_.theta.segment(a, n), theta_l = low_.theta.segment(a, n);
    const auto y_h = high_.y.segment(a, n), y_l = low_.y.segment(a, n);
    D_.weight.segment(a, n) = theta_h + theta_l;
    D_.G.col(kTau).segment(a, n) = theta_h.cwiseProduct(forms_.hi.segment(a, n)) +
                                   theta_l.cwiseProduct(forms_.lo.segment(a, n));
    D_.G.col(kDual).segment(a, n) = y_l - y_h;
    D_.G.col(kStep).segment(a, n) = y_h - y_l + theta_h.cwiseProduct(high_.residual.segment(a, n)) -
                                    theta_l.cwiseProduct(low_.residual.segment(a, n));
  });
  for (const int f : forms_.equations) complementarity -= high_.y[f];
  measure_equations();
  D_.eliminate(forms_, low_, high_);
  D_.sigma.col(kTau).setConstant(-rho_);
  primal_value_ = forms_.cost.dot(X_) - rho_ * sigma_.sum();
  gap_residual_ = kappa_ + dual_value_ - primal_value_;
  mu_ = (complementarity + tau_ * kappa_) / (count_ + 1);
}

/// An equation has a weight and a multiplier of any sign.
void Embedding::measure_equations() {
  for (const int f : forms_.equations) {
    high_.residual[f] = forms_.hi[f] * tau_ - phi_[f];
    high_.theta[f] = D_.weight[f] = kEquation;
    high_.centre[f] = 0;
    D_.G(f, kTau) = kEquation * forms_.hi[f];
    D_.G(f, kStep) = kEquation * high_.residual[f];
  }
}

/// Whether the present point is a verdict that the data confirm.
bool Embedding::settled(const PlanProgram& program, double tolerance, PlanSolution& solution) {
  if (!std::isfinite(mu_)) return false;
  const double size = tau_ + std::abs(primal_value_);
  if (std::abs(dual_value_ - primal_value_) <= tolerance * size && kappa_ < tau_) {
    reader_.read_primal(program, forms_, X_, tau_, solution);
    kept_G_ = high_.y - low_.y;
    reader_.read_dual(program, forms_, kept_G_, tau_, false, solution);
    solution.residual = recheck(program, solution);
    if (solution.residual.within(tolerance * (1 + std::abs(solution.value) + solution.price))) {
      solution.conclude(Status::kOptimal);
      return true;
    }
  }
  if (dual_value_ < 0 && kappa_ > tau_) {
    kept_G_ = high_.y - low_.y;
    reader_.read_dual(program, forms_, kept_G_, -dual_value_, true, solution);
    if (proves_infeasible(program, solution)) {
      solution.conclude(Status::kInfeasible, "no efforts and wrenches balance all instants");
      return true;
    }
  }
  return false;
}

void Embedding::iterate() {
  D_.factor(forms_, least_pivot_);
  predict();
  const double rest = 1 - std::min(1.0, reach());
  const double gamma = std::max(rest * rest * std::min(rest, 0.5), 1e-12);
  const double share = 1 - gamma;
  const double tau_centre = gamma * mu_ - tau_ * kappa_ - d_tau_ * d_kappa_;
  correct(gamma);
  direct(share, tau_centre);
  if (forms_.p > 0) centralise(share, tau_centre, reach());
  if (dual_value_ - primal_value_ < 1e-4 * (tau_ + std::abs(primal_value_))) refine(share);
}

/// The directions of tau and of the predictor, at once.
void Embedding::predict() {
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    const double sigma_residual = high_.y[f] + low_.y[f] - rho_ * tau_;
    D_.sigma(i, kStep) = sigma_residual - high_.y[f] - low_.y[f] -
                         high_.theta[f] * high_.residual[f] - low_.theta[f] * low_.residual[f];
  }
  D_.X.col(kTau) = forms_.cost;
  D_.X.col(kDual) = tau_ * forms_.cost;
  forms_.add_transposed(D_.G.col(kDual), D_.X.col(kDual));
  D_.X.col(kStep) = D_.X.col(kDual);
  D_.solve(forms_, kTau, 2);
  aim_tau();
  finish(1, -tau_ * kappa_);
}

/// What is left of the limits along the direction of tau: sums of squares, which do not cancel.
void Embedding::aim_tau() {
  tau_pivot_ = kappa_ / tau_;
  const auto add = [&](const Side& side, const auto& q, Eigen::Index a, Eigen::Index n) {
    tau_pivot_ += side.theta.segment(a, n).dot(side.drift(q, a, n).cwiseAbs2());
  };
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    add(high_, D_.G.col(kTau), a, n);
    add(low_, D_.low().col(kTau), a, n);
  });
}

/// The direction for the present centre and the share of the residuals that goes.
void Embedding::direct(double share, double tau_centre) {
  push(share);
  D_.X.col(kStep) = share * D_.X.col(kDual);
  D_.solve(forms_, kStep, 1);
  finish(share, tau_centre);
}

void Embedding::push(double share) {
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    D_.G.col(kStep).segment(a, n) = low_.push(share, a, n) - high_.push(share, a, n);
  });
  const auto push = [&](const Side& side, int f) {
    return side.centre[f] * side.inverse_s[f] - share * side.theta[f] * side.residual[f];
  };
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    const double sigma_residual = high_.y[f] + low_.y[f] - rho_ * tau_;
    D_.sigma(i, kStep) = share * sigma_residual + push(high_, f) + push(low_, f);
  }
}

/// d tau, and with it the steps of all slacks and multipliers.
void Embedding::finish(double share, double tau_centre) {
  double right = share * (gap_residual_ + D_.X.col(kTau).dot(D_.X.col(kDual))) + tau_centre / tau_ -
                 forms_.cost.dot(D_.X.col(kStep)) + rho_ * D_.sigma.col(kStep).sum();
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    right += share * D_.sigma(i, kTau) * (high_.y[f] + low_.y[f] - rho_ * tau_);
  }
  const auto pull = [&](const Side& side, const Eigen::MatrixXd& G, Eigen::Index a,
                        Eigen::Index n) {
    const auto moved =
        side.sign * side.theta.segment(a, n).cwiseProduct(G.col(kStep).segment(a, n));
    right += side.drift(G.col(kTau), a, n).dot(side.push(share, a, n) + moved);
  };
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    pull(high_, D_.G, a, n);
    pull(low_, D_.low(), a, n);
  });
  d_tau_ = right / tau_pivot_;
  d_kappa_ = (tau_centre - kappa_ * d_tau_) / tau_;
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    high_.finish(share, d_tau_, D_.G.col(kTau), D_.G.col(kStep), a, n);
    low_.finish(share, d_tau_, D_.low().col(kTau), D_.low().col(kStep), a, n);
  });
  for (const int f : forms_.equations) {
    high_.dy[f] = kEquation * (D_.G(f, kStep) + d_tau_ * (D_.G(f, kTau) - forms_.hi[f]) -
                               share * high_.residual[f]);
  }
}

/// Mehrotra's centre after the predictor.
void Embedding::correct(double gamma) {
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    for (Side* side : {&high_, &low_}) {
      side->centre.segment(a, n) += gamma * mu_ * side->has->segment(a, n) -
                                    side->ds.segment(a, n).cwiseProduct(side->dy.segment(a, n));
    }
  });
}

/// Gondzio's corrections: products that a longer step would leave far from mu are pulled back. One
/// that does not lengthen the step is taken back.
void Embedding::centralise(double share, double tau_centre, double step) {
  for (int count = 0; count < kCorrections && step < 0.9; ++count) {
    const double trial = std::min(1.0, step + 0.2);
    const double mu = (1 - trial * share) * mu_;
    for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
      high_.pull(trial, mu, a, n);
      low_.pull(trial, mu, a, n);
    });
    direct(share, tau_centre);
    const double longer = reach();
    if (longer < step + kLonger) {
      high_.centre -= high_.correction;
      low_.centre -= low_.correction;
      direct(share, tau_centre);
      return;
    }
    step = longer;
  }
}

/// Takes from the multipliers' steps what rounding of the normal equations left in A'dy.
void Embedding::refine(double share) {
  kept_X_ = D_.X.col(kStep);
  kept_G_ = D_.G.col(kStep);
  kept_sigma_ = D_.sigma.col(kStep);
  if (split()) kept_low_ = D_.G_low.col(kStep);
  D_.X.col(kStep) = share * D_.X.col(kDual) + d_tau_ * forms_.cost;
  D_.G.col(kStep) = low_.dy - high_.dy;
  forms_.add_transposed(D_.G.col(kStep), D_.X.col(kStep));
  D_.G.col(kStep).setZero();
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    D_.sigma(i, kStep) =
        share * (high_.y[f] + low_.y[f] - rho_ * tau_) - d_tau_ * rho_ + high_.dy[f] + low_.dy[f];
  }
  D_.solve(forms_, kStep, 1);
  const auto add = [&](Side& side, const Eigen::MatrixXd& G) {
    side.ds -= side.sign * G.col(kStep).cwiseProduct(*side.has);
    side.dy += side.sign * side.theta.cwiseProduct(G.col(kStep));
  };
  add(high_, D_.G);
  add(low_, D_.low());
  D_.X.col(kStep) += kept_X_;
  D_.G.col(kStep) += kept_G_;
  D_.sigma.col(kStep) += kept_sigma_;
  if (split()) D_.G_low.col(kStep) += kept_low_;
}

/// The longest step up to 1,000 that keeps s, y, tau and kappa positive.
double Embedding::reach() const {
  double falls = std::max(1e-3, std::max(-d_tau_ / tau_, -d_kappa_ / kappa_));
  for_chunks(forms_.size, [&](Eigen::Index a, Eigen::Index n) {
    falls = std::max(falls, std::max(high_.falls(a, n), low_.falls(a, n)));
  });
  return 1 / falls;
}

const char* Embedding::reason() const {
  if (primal_value_ > 0 && kappa_ > tau_) return "the value seems to grow without limit";
  return "the interior point method ends without a verdict that the data confirm";
}

}  // namespace maxwrench
