#include "solvers/plan/forms_reader.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "solvers/plan/forms.h"

namespace maxwrench {
namespace {

/// Added to the products of the columns of J'W, which may be dependent, as a share of their trace.
constexpr double kGram = 1e-13;
/// Instants whose lambda is below this share of the largest take no part in a proof.
constexpr double kPart = 1e-10;
/// And entries below this are rounding.
constexpr double kRest = 1e-12;

}  // namespace

void FormsReader::read_primal(const PlanProgram& program, const Forms& forms,
                              const Eigen::VectorXd& X, double tau, PlanSolution& solution) {
  const int m = forms.actuation->actuators();
  const int n = forms.actuation->dimension();
  solution.u.resize(m, forms.N);
  solution.s.setZero(n, forms.N);
  solution.w.resize(forms.N);
  solution.y = X.tail(forms.p) / tau;
  solution.price = 0;
  solution.value = kInfinity;
  for (int i = 0; i < forms.N; ++i) {
    const Forms::Stage& at = forms.stages[i];
    const WrenchProgram& data = program.instants[i];
    const int k = data.columns();
    solution.w[i] = X.segment(at.x0 + at.w, k) / tau;
    for (int r = 0; r < m; ++r) {
      double u = forms.F_of(at).row(r).dot(X.segment(at.x0, at.d)) / tau;
      if (forms.p > 0) u += forms.D.row(at.f0 + r).dot(solution.y);
      solution.u(forms.order[r], i) = u + forms.offsets(forms.order[r], i);
    }
    if (i == program.peak || forms.t > 0) {
      solution.value = std::min(solution.value, data.c_w.dot(solution.w[i]));
    }
    if (!at.elastic) continue;
    auto s = solution.s.col(i);
    s = data.tau_d;
    s.noalias() += data.JtW.lazyProduct(solution.w[i]);
    s.noalias() -= forms.actuation->B.lazyProduct(solution.u.col(i));
    if (forms.p > 0) s.noalias() -= program.G[i] * solution.y;
    solution.price += program.rho * s.lpNorm<1>();
  }
}

void FormsReader::read_dual(const PlanProgram& program, const Forms& forms,
                            const Eigen::VectorXd& multipliers, double tau, bool proof,
                            PlanSolution& solution) {
  read_rates(program, forms, multipliers, tau, solution);
  if (!proof) read_pi(program, forms, multipliers, solution);
  for (int i = 0; i < forms.N; ++i) {
    if (!(forms.stages[i].elastic && proof)) {
      read_lambda(program, forms, multipliers, tau, i, solution);
    }
  }
  if (proof) turn_to_proof(solution.lambda);
}

/// mu and nu; nothing yet in the others.
void FormsReader::read_rates(const PlanProgram& program, const Forms& forms,
                             const Eigen::VectorXd& multipliers, double tau,
                             PlanSolution& solution) {
  solution.lambda.setZero(forms.actuation->dimension(), forms.N);
  solution.mu.setZero(forms.actuation->actuators(), forms.N - 1);
  solution.pi.setZero(forms.N);
  solution.nu = multipliers.tail(program.R.rows()) / tau;
  for (int i = 0; i + 1 < forms.N; ++i) {
    for (int r = 0; r < forms.rated; ++r) {
      solution.mu(forms.order[r], i) = multipliers[forms.rates0 + forms.rated * i + r] / tau;
    }
  }
}

/// In a proof those of t would add up to nothing.
void FormsReader::read_pi(const PlanProgram& program, const Forms& forms,
                          const Eigen::VectorXd& multipliers, PlanSolution& solution) {
  if (forms.t == 0) {
    solution.pi[program.peak] = 1;
    return;
  }
  for (int i = 0; i < forms.N; ++i) {
    solution.pi[i] = -multipliers[forms.stages[i].f0 + forms.stages[i].count - 1];
  }
  solution.pi /= solution.pi.sum();
}

void FormsReader::read_lambda(const PlanProgram& program, const Forms& forms,
                              const Eigen::VectorXd& multipliers, double tau, int i,
                              PlanSolution& solution) {
  const Forms::Stage& at = forms.stages[i];
  auto lambda = solution.lambda.col(i);
  for (int r = 0; r < forms.actuation->actuators(); ++r) {
    const int j = forms.order[r];
    double g = multipliers[at.f0 + r] / tau;
    if (i > 0) g += solution.mu(j, i - 1);
    if (i + 1 < forms.N) g -= solution.mu(j, i);
    lambda -= forms.actuation->B_pinv.row(j).transpose() * g;
  }
  const int first = at.f0 + at.w0 + at.w_count + at.w;
  for (int q = 0; q < forms.P.cols(); ++q) {
    lambda -= forms.P.col(q) * (multipliers[first + q] / tau);
  }
  level(program, forms, multipliers, tau, i, solution);
}

/// Proofs have the other sign, and no rounding.
void FormsReader::turn_to_proof(Eigen::MatrixXd& all) {
  const double largest = all.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < all.cols(); ++i) {
    auto lambda = all.col(i);
    lambda *= lambda.lpNorm<Eigen::Infinity>() < kPart * largest ? 0 : -1;
    for (double& entry : lambda) {
      if (std::abs(entry) < kRest * largest) entry = 0;
    }
  }
}

/// lambda -= J'W (W'J J'W)^-1 (pi c_w + W'J lambda - multipliers of w).
void FormsReader::level(const PlanProgram& program, const Forms& forms,
                        const Eigen::VectorXd& multipliers, double tau, int i,
                        PlanSolution& solution) {
  const WrenchProgram& data = program.instants[i];
  auto lambda = solution.lambda.col(i);
  gram_.resize(data.columns(), data.columns());
  gram_.noalias() = data.JtW.transpose().lazyProduct(data.JtW);
  gram_.diagonal().array() += kGram * gram_.trace();
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(gram_);
  if (factors.info() != Eigen::Success) return;
  // Once more for what was added.
  for (int pass = 0; pass < 2; ++pass) {
    slope_ = solution.pi[i] * data.c_w;
    slope_.noalias() += data.JtW.transpose().lazyProduct(lambda);
    int form = forms.stages[i].f0 + forms.stages[i].w0;
    for (int j = 0; j < data.columns(); ++j) {
      if (has_limits(data, j)) slope_[j] -= multipliers[form++] / tau;
    }
    factors.solveInPlace(slope_);
    lambda.noalias() -= data.JtW.lazyProduct(slope_);
  }
}

}  // namespace maxwrench
