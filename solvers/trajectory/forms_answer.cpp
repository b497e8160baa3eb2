#include <algorithm>
#include <cmath>

#include "solvers/trajectory/forms.h"

// Computes the answer of a trajectory program from that of its forms.

namespace maxwrench {
namespace {

/// Added to the Gram matrix of the columns of J'W, which may be dependent, as a share of its trace.
constexpr double kGram = 1e-13;
/// Instants whose lambda is below this share of the largest are left out of a proof.
constexpr double kPart = 1e-10;
/// Entries below this share are rounding errors.
constexpr double kRest = 1e-12;

}  // namespace

void Forms::read_primal(const TrajectoryProgram& program, const Eigen::VectorXd& X, double tau,
                        TrajectorySolution& solution) const {
  const int m = actuation_->actuators();
  const int n = actuation_->dimension();
  solution.u.resize(m, N);
  solution.s.setZero(n, N);
  solution.w.resize(N);
  solution.y = X.tail(p) / tau;
  solution.price = 0;
  solution.value = kInfinity;
  for (int i = 0; i < N; ++i) {
    const Stage& at = stages[i];
    const WrenchProgram& data = program.instants[i];
    const int k = data.columns();
    solution.w[i] = X.segment(at.x0 + at.w, k) / tau;
    for (int r = at.efforts; r < m; ++r) {
      solution.u(order[r], i) = slopes_(r, i) * solution.w[i][0] + offsets_(order[r], i);
    }
    for (int r = 0; r < at.efforts; ++r) {
      double u = F_of(at).row(r).dot(X.segment(at.x0, at.d)) / tau;
      if (p > 0) u += D.row(at.f0 + r).dot(solution.y);
      solution.u(order[r], i) = u + offsets_(order[r], i);
    }
    if (i == program.peak || at.has_t) {
      solution.value = std::min(solution.value, data.c_w.dot(solution.w[i]));
    }
    if (!at.elastic) continue;
    auto s = solution.s.col(i);
    s = data.tau_d;
    s.noalias() += data.JtW.lazyProduct(solution.w[i]);
    s.noalias() -= actuation_->B.lazyProduct(solution.u.col(i));
    if (p > 0) s.noalias() -= program.G[i] * solution.y;
    solution.price += program.rho * s.lpNorm<1>();
  }
}

void Forms::read_dual(const TrajectoryProgram& program, const Eigen::VectorXd& multipliers,
                      double tau, bool proof, TrajectorySolution& solution) {
  const int m = actuation_->actuators();
  solution.lambda.setZero(actuation_->dimension(), N);
  solution.mu.setZero(m, N - 1);
  solution.pi.setZero(N);
  solution.nu = multipliers.tail(program.R.rows()) / tau;
  for (int i = 0; i + 1 < N; ++i) {
    for (int r = 0; r < rated; ++r) {
      solution.mu(order[r], i) = multipliers[rates0 + rated * i + r] / tau;
    }
  }
  solution.kappa.setZero(program.lag.rows(), program.lag.cols());
  for (int i = 0; lagged && i + 1 < N; ++i) {
    for (int r = 0; r < rated; ++r) {
      solution.kappa(order[r], i) = multipliers[commands0 + rated * i + r] / tau;
    }
  }
  // In a proof, the multipliers of t sum to zero: those of limits on one side vanish.
  for (int i = 0; t > 0 && (!proof || program.common) && i < N; ++i) {
    if (stages[i].has_t) solution.pi[i] = -multipliers[stages[i].f0 + stages[i].count - 1];
  }
  if (t > 0 && !proof) solution.pi /= solution.pi.sum();
  if (proof && program.common) solution.pi /= tau;
  if (t == 0 && !proof) solution.pi[program.peak] = 1;
  for (int i = 0; i < N; ++i) {
    const Stage& at = stages[i];
    if (at.elastic && proof) continue;
    auto lambda = solution.lambda.col(i);
    for (int r = 0; r < m; ++r) {
      const int j = order[r];
      double g = effort_multiplier(multipliers, i, r) / tau;
      if (i > 0) g += solution.mu(j, i - 1);
      if (i + 1 < N) g -= solution.mu(j, i);
      if (i > 0 && program.lags(j, i - 1)) {
        g += (1 + program.lag(j, i - 1)) * solution.kappa(j, i - 1);
      }
      if (i + 1 < N && program.lags(j, i)) g -= program.lag(j, i) * solution.kappa(j, i);
      lambda -= actuation_->B_pinv.row(j).transpose() * g;
    }
    const int first = at.f0 + at.w0 + at.w_count + at.w;
    for (int q = 0; q < P_.cols(); ++q) lambda -= P_.col(q) * (multipliers[first + q] / tau);
    level(program, multipliers, tau, i, solution);
  }
  if (proof) sign_proof(solution);
}

/// Gives the multipliers the signs of a proof of infeasibility and removes rounding errors.
void Forms::sign_proof(TrajectorySolution& solution) const {
  const double largest = solution.lambda.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < N; ++i) {
    auto lambda = solution.lambda.col(i);
    lambda *= lambda.lpNorm<Eigen::Infinity>() < kPart * largest ? 0 : -1;
    for (double& entry : lambda) {
      if (std::abs(entry) < kRest * largest) entry = 0;
    }
  }
}

/// lambda -= J'W (W'J J'W)^-1 (pi c_w + W'J lambda - multipliers of w).
void Forms::level(const TrajectoryProgram& program, const Eigen::VectorXd& multipliers, double tau,
                  int i, TrajectorySolution& solution) {
  const WrenchProgram& data = program.instants[i];
  if (data.columns() == 0) return;
  auto lambda = solution.lambda.col(i);
  gram_.resize(data.columns(), data.columns());
  gram_.noalias() = data.JtW.transpose().lazyProduct(data.JtW);
  gram_.diagonal().array() += kGram * gram_.trace();
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(gram_);
  if (factors.info() != Eigen::Success) return;
  // The second pass corrects the rounding of the first.
  for (int pass = 0; pass < 2; ++pass) {
    slope_ = solution.pi[i] * data.c_w;
    slope_.noalias() += data.JtW.transpose().lazyProduct(lambda);
    int form = stages[i].f0 + stages[i].w0;
    for (int j = 0; j < data.columns(); ++j) {
      if (has_limits(data, j)) slope_[j] -= multipliers[form++] / tau;
    }
    factors.solveInPlace(slope_);
    lambda.noalias() -= data.JtW.lazyProduct(slope_);
  }
}

}  // namespace maxwrench
