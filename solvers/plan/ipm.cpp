#include <algorithm>
#include <cmath>

#include "solvers/plan/makers.h"
#include "solvers/plan/normal_matrix.h"
#include "solvers/plan/slacks.h"

namespace maxwrench {
namespace {

constexpr int kMaxIterations = 150;
/// An equation's weight in the normal equations; what this leaves of it vanishes with the steps.
constexpr double kEquation = 1e8;
/// The share of the way to the boundary that a step goes.
constexpr double kBoundary = 0.99;

class Ipm : public PlanSolver {
 public:
  explicit Ipm(double tolerance) : tolerance_(tolerance) {}

  void solve(const PlanProgram& program, PlanSolution& solution) override {
    forms_.build(program);
    matrix_.reserve(forms_);
    start(program);
    solution.basis.clear();
    for (solution.iterations = 0;; ++solution.iterations) {
      measure();
      if (settled(program, solution)) return;
      if (solution.iterations == kMaxIterations || !(mu_ > 1e-20) || stuck_ > 3) break;
      iterate();
    }
    solution.conclude(Status::kNumericalError, reason());
  }

 private:
  /// Residuals of the embedding at the present point.
  void measure() {
    const Eigen::VectorXd &lo = forms_.lo, &hi = forms_.hi;
    dual_value_ = 0;
    double complementarity = 0;
    for_chunks(hi.size(), [&](Eigen::Index a, Eigen::Index n) {
      const auto phi = phi_.segment(a, n);
      const auto h = hi.segment(a, n), l = lo.segment(a, n);
      const auto s_h = high_.s.segment(a, n), s_l = low_.s.segment(a, n);
      const auto y_h = high_.y.segment(a, n), y_l = low_.y.segment(a, n);
      high_.residual.segment(a, n) =
          (h * tau_ - phi - s_h).cwiseProduct(forms_.has_hi.segment(a, n));
      low_.residual.segment(a, n) =
          (phi - l * tau_ - s_l).cwiseProduct(forms_.has_lo.segment(a, n));
      work_.segment(a, n) = y_l - y_h;
      dual_value_ += h.dot(y_h) - l.dot(y_l);
      complementarity += s_h.dot(y_h) + s_l.dot(y_l);
    });
    for (const int f : forms_.equations) high_.residual[f] = hi[f] * tau_ - phi_[f];
    dual_residual_ = forms_.cost * tau_;
    forms_.add_transposed(work_, dual_residual_);
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      const int f = forms_.slacks[i];
      high_.residual[f] += sigma_[i];
      low_.residual[f] += sigma_[i];
      sigma_residual_[i] = high_.y[f] + low_.y[f] - rho_ * tau_;
    }
    primal_value_ = forms_.cost.dot(X_) - rho_ * sigma_.sum();
    gap_residual_ = kappa_ + dual_value_ - primal_value_;
    // The multiplier of an equation is not one of a limit.
    for (const int f : forms_.equations) complementarity -= high_.y[f];
    mu_ = (complementarity + tau_ * kappa_) / (count_ + 1);
  }

  void start(const PlanProgram& program) {
    const int size = forms_.size;
    for (Slacks* side : {&low_, &high_}) side->resize(size);
    for (Eigen::VectorXd* x : {&phi_, &weight_, &work_, &q_phi_, &d_phi_}) x->resize(size);
    rho_ = program.elastic() ? program.rho : 0;
    count_ = forms_.has_lo.sum() + forms_.has_hi.sum();
    const double mu = 30.0 / forms_.N;
    scale_ = forms_.scale;
    for (int i = 0; forms_.t > 0 && i < forms_.N; ++i) {
      scale_[forms_.stages[i].f0 + forms_.stages[i].count - 1] = 30;
    }
    low_.start(forms_.has_lo, scale_, mu);
    high_.start(forms_.has_hi, scale_, mu);
    X_.setZero(forms_.variables);
    phi_.setZero();
    const auto slacks = static_cast<Eigen::Index>(forms_.slacks.size());
    sigma_.setOnes(slacks);
    for (Eigen::VectorXd* x : {&sigma_residual_, &q_sigma_, &d_sigma_, &s_phi_, &s_diagonal_}) {
      x->setZero(slacks);
    }
    for (const int f : forms_.slacks) {
      low_.y[f] = high_.y[f] = 0.5 * rho_;
      low_.s[f] = high_.s[f] = 1;
    }
    tau_ = 1;
    kappa_ = mu;
    stuck_ = 0;
  }

  /// Centres of the predictor and H of the normal equations, after the slacks' own columns are
  /// eliminated.
  void factor() {
    for_chunks(weight_.size(), [&](Eigen::Index a, Eigen::Index n) {
      high_.invert(forms_.has_hi, a, n);
      low_.invert(forms_.has_lo, a, n);
      weight_.segment(a, n) = high_.theta.segment(a, n) + low_.theta.segment(a, n);
      high_.centre.segment(a, n) = -high_.s.segment(a, n).cwiseProduct(high_.y.segment(a, n));
      low_.centre.segment(a, n) = -low_.s.segment(a, n).cwiseProduct(low_.y.segment(a, n));
    });
    for (const int f : forms_.equations) {
      high_.theta[f] = weight_[f] = kEquation;
      high_.centre[f] = 0;
    }
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      const int f = forms_.slacks[i];
      const double h = high_.theta[f], l = low_.theta[f];
      s_diagonal_[i] = h + l;
      s_phi_[i] = l - h;
      weight_[f] = 4 * h * l / (h + l);
    }
    matrix_.factor(forms_, weight_);
  }

  /// H (X, sigma) = (X + phi's map of g, r_sigma): X and d_phi, sigma in place of theirs.
  void solve_normal(Eigen::VectorXd& g, Eigen::VectorXd& r_sigma, Eigen::VectorXd& X,
                    Eigen::VectorXd& d_phi) {
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      g[forms_.slacks[i]] -= s_phi_[i] / s_diagonal_[i] * r_sigma[i];
    }
    forms_.add_transposed(g, X);
    matrix_.solve(forms_, X);
    forms_.apply(X, d_phi);
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      r_sigma[i] = (r_sigma[i] - s_phi_[i] * d_phi[forms_.slacks[i]]) / s_diagonal_[i];
    }
  }

  /// The direction q that belongs to tau, and what is left of the limits: sums of squares and
  /// products with it do not cancel.
  void direct_tau() {
    work_ = high_.theta.cwiseProduct(forms_.hi) + low_.theta.cwiseProduct(forms_.lo);
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      const int f = forms_.slacks[i];
      q_sigma_[i] = low_.theta[f] * forms_.lo[f] - high_.theta[f] * forms_.hi[f] - rho_;
    }
    q_ = forms_.cost;
    solve_normal(work_, q_sigma_, q_, q_phi_);
    high_.drift = forms_.hi - q_phi_;
    low_.drift = q_phi_ - forms_.lo;
    add_sigma(q_sigma_, high_.drift, low_.drift);
    tau_pivot_ = kappa_ / tau_;
    for_chunks(work_.size(), [&](Eigen::Index a, Eigen::Index n) {
      for (const Slacks* side : {&high_, &low_}) {
        const auto drift = side->drift.segment(a, n);
        tau_pivot_ += side->theta.segment(a, n).cwiseProduct(drift).dot(drift);
      }
    });
  }

  /// The slacks' sigma is part of both rows of their forms.
  void add_sigma(const Eigen::VectorXd& sigma, Eigen::VectorXd& high, Eigen::VectorXd& low) const {
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      high[forms_.slacks[i]] += sigma[i];
      low[forms_.slacks[i]] += sigma[i];
    }
  }

  /// Steps of everything for `centre` (what s y should change by) and the share of the residuals
  /// that goes.
  void direct(double share, double tau_centre) {
    const Eigen::Index size = work_.size();
    for_chunks(size, [&](Eigen::Index a, Eigen::Index n) {
      high_.push(share, a, n);
      low_.push(share, a, n);
      work_.segment(a, n) = low_.v.segment(a, n) - high_.v.segment(a, n);
    });
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      const int f = forms_.slacks[i];
      d_sigma_[i] = share * sigma_residual_[i] + high_.v[f] + low_.v[f];
    }
    dX_ = share * dual_residual_;
    solve_normal(work_, d_sigma_, dX_, d_phi_);
    high_.ds = -d_phi_;
    low_.ds = d_phi_;
    add_sigma(d_sigma_, high_.ds, low_.ds);
    double right =
        share * (gap_residual_ + q_.dot(dual_residual_) + q_sigma_.dot(sigma_residual_)) +
        tau_centre / tau_ - forms_.cost.dot(dX_) + rho_ * d_sigma_.sum();
    for_chunks(
        size, [&](Eigen::Index a, Eigen::Index n) { right += high_.pull(a, n) + low_.pull(a, n); });
    d_tau_ = right / tau_pivot_;
    d_kappa_ = (tau_centre - kappa_ * d_tau_) / tau_;
    dX_ += d_tau_ * q_;
    d_sigma_ += d_tau_ * q_sigma_;
    for_chunks(size, [&](Eigen::Index a, Eigen::Index n) {
      d_phi_.segment(a, n) += d_tau_ * q_phi_.segment(a, n);
      high_.finish(share, d_tau_, forms_.has_hi, a, n);
      low_.finish(share, d_tau_, forms_.has_lo, a, n);
    });
    for (const int f : forms_.equations) {
      high_.dy[f] = kEquation * (d_phi_[f] - d_tau_ * forms_.hi[f] - share * high_.residual[f]);
    }
  }

  /// Takes from the multipliers' steps what rounding of the normal equations left in A'dy.
  void refine(double share) {
    kept_X_ = dX_;
    kept_phi_ = d_phi_;
    kept_sigma_ = d_sigma_;
    work_ = low_.dy - high_.dy;
    dX_ = share * dual_residual_ + d_tau_ * forms_.cost;
    forms_.add_transposed(work_, dX_);
    work_.setZero();
    for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
      const int f = forms_.slacks[i];
      d_sigma_[i] = share * sigma_residual_[i] - d_tau_ * rho_ + high_.dy[f] + low_.dy[f];
    }
    solve_normal(work_, d_sigma_, dX_, d_phi_);
    high_.v = -d_phi_;
    low_.v = d_phi_;
    add_sigma(d_sigma_, high_.v, low_.v);
    for (Slacks* side : {&high_, &low_}) {
      side->ds += side->v;
      side->dy -= side->theta.cwiseProduct(side->v);
    }
    dX_ += kept_X_;
    d_phi_ += kept_phi_;
    d_sigma_ += kept_sigma_;
    high_.ds.array() *= forms_.has_hi.array();
    low_.ds.array() *= forms_.has_lo.array();
  }

  double reach() const {
    double step = std::min(high_.reach(1e3), low_.reach(1e3));
    if (d_tau_ < 0) step = std::min(step, -tau_ / d_tau_);
    if (d_kappa_ < 0) step = std::min(step, -kappa_ / d_kappa_);
    return step;
  }

  void iterate() {
    factor();
    direct_tau();
    direct(1, -tau_ * kappa_);
    const double far = std::min(1.0, reach());
    const double rest = 1 - far;
    const double gamma = std::max(rest * rest * std::min(rest, 0.5), 1e-12);
    for_chunks(work_.size(), [&](Eigen::Index a, Eigen::Index n) {
      const auto add = [&](Slacks& side, const Eigen::VectorXd& has) {
        side.centre.segment(a, n) += gamma * mu_ * has.segment(a, n) -
                                     side.ds.segment(a, n).cwiseProduct(side.dy.segment(a, n));
      };
      add(high_, forms_.has_hi);
      add(low_, forms_.has_lo);
    });
    direct(1 - gamma, gamma * mu_ - tau_ * kappa_ - d_tau_ * d_kappa_);
    if (dual_value_ - primal_value_ < 1e-4 * (tau_ + std::abs(primal_value_))) refine(1 - gamma);
    const double step = std::min(1.0, kBoundary * reach());
    stuck_ = step < 1e-4 ? stuck_ + 1 : 0;
    advance(step);
  }

  void advance(double step) {
    for (Slacks* side : {&low_, &high_}) {
      side->s += step * side->ds;
      side->y += step * side->dy;
    }
    X_ += step * dX_;
    phi_ += step * d_phi_;
    sigma_ += step * d_sigma_;
    tau_ += step * d_tau_;
    kappa_ += step * d_kappa_;
  }

  /// Whether the present point is a verdict that the data confirm.
  bool settled(const PlanProgram& program, PlanSolution& solution) {
    if (!std::isfinite(mu_)) return false;
    const double size = tau_ + std::abs(primal_value_);
    if (std::abs(dual_value_ - primal_value_) <= tolerance_ * size && kappa_ < tau_) {
      work_ = high_.y - low_.y;
      forms_.read_primal(program, X_, tau_, solution);
      forms_.read_dual(program, work_, tau_, false, solution);
      solution.residual = recheck(program, solution);
      const double tolerance = tolerance_ * (1 + std::abs(solution.value) + solution.price);
      if (solution.residual.within(tolerance)) {
        solution.conclude(Status::kOptimal);
        return true;
      }
    }
    if (dual_value_ < 0 && kappa_ > tau_) {
      work_ = high_.y - low_.y;
      forms_.read_dual(program, work_, -dual_value_, true, solution);
      if (proves_infeasible(program, solution)) {
        solution.conclude(Status::kInfeasible, "no efforts and wrenches balance all instants");
        return true;
      }
    }
    return false;
  }

  const char* reason() const {
    if (primal_value_ > 0 && kappa_ > tau_) return "the value seems to grow without limit";
    return "the interior point method ends without a verdict that the data confirm";
  }

  const double tolerance_;  ///< how far an optimum may be off, relative to 1 + |value|
  Forms forms_;
  NormalMatrix matrix_;
  Slacks low_, high_;
  Eigen::VectorXd kept_X_, kept_phi_, kept_sigma_;
  Eigen::VectorXd X_, dX_, q_, dual_residual_, scale_;
  Eigen::VectorXd phi_, d_phi_, q_phi_, weight_, work_;
  Eigen::VectorXd sigma_, d_sigma_, q_sigma_, sigma_residual_, s_phi_, s_diagonal_;
  double tau_ = 1, kappa_ = 1, d_tau_ = 0, d_kappa_ = 0;
  double mu_ = 0, rho_ = 0, count_ = 0, dual_value_ = 0, primal_value_ = 0, gap_residual_ = 0;
  double tau_pivot_ = 0;
  int stuck_ = 0;
};

}  // namespace

std::unique_ptr<PlanSolver> make_plan_ipm(double tolerance) {
  return std::make_unique<Ipm>(tolerance);
}

}  // namespace maxwrench
