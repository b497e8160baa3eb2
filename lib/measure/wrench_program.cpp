#include "maxwrench/wrench_program.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lib/math/farkas.h"
#include "lib/math/rotated.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

/// The largest violation of the limits by x; infinity for NaN.
double outside(const Eigen::VectorXd& x, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  double worst = 0;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    if (x[j] >= low[j] && x[j] <= high[j]) continue;
    const double by = x[j] >= low[j] ? x[j] - high[j] : low[j] - x[j];
    if (!(by <= worst)) worst = std::isnan(by) ? kInfinity : by;
  }
  return worst;
}

/// The loop has no jumps, so that the compiler vectorises it.
template <class X>
bool all_finite(const X& x) {
  const double* const numbers = x.data();
  std::int64_t others = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) others |= std::abs(numbers[i]) < kInfinity ? 0 : 1;
  return others == 0;
}

bool posture_is_finite(const WrenchProgram& program) {
  return all_finite(program.JtW) && all_finite(program.tau_d);
}

}  // namespace

bool well_formed(const WrenchProgram& program) {
  const Eigen::Index n = program.tau_d.size(), k = program.c_w.size();
  if (program.actuation == nullptr || program.actuation->dimension() != n) return false;
  if (program.JtW.rows() != n || program.JtW.cols() != k) return false;
  if (program.w_min.size() != k || program.w_max.size() != k) return false;
  if (program.W.cols() + program.C_2.cols() != k) return false;
  if (!all_finite(program.W) || !all_finite(program.C_2) || !all_finite(program.c_w)) return false;
  if (!posture_is_finite(program)) return false;
  for (Eigen::Index j = 0; j < k; ++j) {
    if (!(program.w_min[j] < kInfinity && program.w_max[j] > -kInfinity)) return false;
  }
  return true;
}

void WrenchSolver::solve(const WrenchProgram& program, bool efforts, Capability& capability) {
  if (!well_formed(program)) {
    capability.conclude(Status::kNumericalError, kMalformed);
    return;
  }
  solve_well_formed(program, efforts, capability);
  if (capability.status == Status::kOptimal && !std::isfinite(capability.beta)) {
    capability.conclude(Status::kNumericalError, "the value is not finite");
  }
}

WrenchProgram make_wrench_program(const Problem& problem, Wrench wrench) {
  WrenchProgram program;
  program.actuation = &problem.robot.actuation;
  program.W = wrench == Wrench::kPure ? Matrix6Xd(problem.c) : problem.W_any;
  if (problem.free.wrench_turns) program.W_0 = program.W;
  const Eigen::Index own = program.W.cols();
  const Eigen::Index l = problem.contact_columns();
  const Eigen::Index k = own + l;
  const Eigen::Index n = problem.robot.velocities();
  program.C_2 = Matrix6Xd::Zero(6, l);
  program.c_w = Eigen::VectorXd::Zero(k);
  program.c_w.head(own) = program.W.transpose() * problem.c;
  program.w_min = Eigen::VectorXd::Constant(k, -kInfinity);
  program.w_max = Eigen::VectorXd::Constant(k, kInfinity);
  if (l > 0) {
    program.w_min.tail(l) = problem.contact->w_min;
    program.w_max.tail(l) = problem.contact->w_max;
  }
  program.JtW = Eigen::MatrixXd::Zero(n, k);
  program.tau_d = Eigen::VectorXd::Zero(n);
  return program;
}

bool set_posture(const Posture& posture, WrenchProgram& program) {
  program.tau_d = posture.tau_d;
  if (program.W_0.cols() > 0) rotate_into(posture.turn, program.W_0, program.W);
  if (program.columns() == program.W.cols()) {
    program.JtW.noalias() = posture.J.transpose().lazyProduct(program.W);
    return posture_is_finite(program);
  }
  program.C_2 = posture.C_2;
  program.JtW.leftCols(program.W.cols()).noalias() = posture.J.transpose().lazyProduct(program.W);
  program.JtW.rightCols(program.C_2.cols()).noalias() =
      posture.J_2.transpose().lazyProduct(program.C_2);
  return posture_is_finite(program);
}

void fill_wrenches(const Posture& posture, const WrenchProgram& program, Capability& capability) {
  const Eigen::Index l = program.columns() - program.W.cols();
  if (l == 0) {
    capability.h.noalias() = program.W * capability.w;
  } else {
    const auto w_2 = capability.w.tail(l);
    capability.h.noalias() = program.W * capability.w.head(program.W.cols());
    capability.h_2.noalias() = program.C_2.lazyProduct(w_2);
    capability.beta_J2.noalias() = capability.h_2 * capability.lambda.transpose();
    const Vector6d twist = posture.J_2.lazyProduct(capability.lambda);
    capability.beta_C2.noalias() = twist * w_2.transpose();
  }
  capability.beta_J.noalias() = capability.h * capability.lambda.transpose();
}

LinearProgram assemble(const WrenchProgram& program) {
  const Zonotope& actuation = *program.actuation;
  const int n = actuation.dimension();
  const int m = actuation.actuators();
  const int k = program.columns();
  LinearProgram lp;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      if (actuation.B(i, j) != 0) entries.emplace_back(i, j, actuation.B(i, j));
    }
  }
  // Every entry of -J'W is stored, even if it is zero, so that the pattern is the same for all
  // postures.
  for (int j = 0; j < k; ++j) {
    for (int i = 0; i < n; ++i) entries.emplace_back(i, m + j, 0.0);
  }
  lp.A.resize(n, m + k);
  lp.A.setFromTriplets(entries.begin(), entries.end());
  lp.b.resize(n);
  lp.c = Eigen::VectorXd::Zero(m + k);
  lp.l.resize(m + k);
  lp.u.resize(m + k);
  lp.l.head(m) = actuation.u_min;
  lp.u.head(m) = actuation.u_max;
  update(program, lp);
  return lp;
}

void update(const WrenchProgram& program, LinearProgram& assembled) {
  const int m = program.actuation->actuators();
  const int k = program.columns();
  assembled.c.tail(k) = program.c_w;
  assembled.l.tail(k) = program.w_min;
  assembled.u.tail(k) = program.w_max;
  assembled.b = program.tau_d;
  for (int j = 0; j < k; ++j) {
    double* values = assembled.A.valuePtr() + assembled.A.outerIndexPtr()[m + j];
    for (Eigen::Index i = 0; i < program.JtW.rows(); ++i) values[i] = -program.JtW(i, j);
  }
}

Residual recheck(const WrenchProgram& program, const Eigen::VectorXd& u, const Eigen::VectorXd& w,
                 const Eigen::VectorXd& lambda) {
  const Zonotope& set = *program.actuation;
  Residual residual{kInfinity, kInfinity, kInfinity, kInfinity};
  if (u.size() != set.actuators() || w.size() != program.columns()) return residual;
  if (lambda.size() != set.dimension() || !u.allFinite() || !w.allFinite()) return residual;
  const Eigen::VectorXd missed = set.B * u - program.JtW * w - program.tau_d;
  if (!lambda.allFinite() || !missed.allFinite()) return residual;
  residual.balance = missed.lpNorm<Eigen::Infinity>();
  residual.bounds =
      std::max(outside(u, set.u_min, set.u_max), outside(w, program.w_min, program.w_max));
  residual.dual = 0;
  double dual_objective = lambda.dot(program.tau_d);
  const auto add = [&](double slope, double low, double high) {
    const double end = slope > 0 ? high : low;
    if (slope == 0) return;
    if (std::isfinite(end)) {
      dual_objective += slope * end;
    } else {
      residual.dual = std::max(residual.dual, std::abs(slope));
    }
  };
  const Eigen::VectorXd u_slope = -(set.B.transpose() * lambda);
  const Eigen::VectorXd w_slope = program.c_w + program.JtW.transpose() * lambda;
  for (Eigen::Index j = 0; j < u.size(); ++j) add(u_slope[j], set.u_min[j], set.u_max[j]);
  for (Eigen::Index j = 0; j < w.size(); ++j) add(w_slope[j], program.w_min[j], program.w_max[j]);
  const double gap = std::abs(dual_objective - program.c_w.dot(w));
  if (gap < kInfinity) residual.gap = gap;
  return residual;
}

bool proves_infeasible(const WrenchProgram& program, const Eigen::VectorXd& y) {
  const Zonotope& set = *program.actuation;
  if ((set.u_min.array() > set.u_max.array()).any()) return true;
  if ((program.w_min.array() > program.w_max.array()).any()) return true;
  if (y.size() != set.dimension() || !y.allFinite()) return false;
  Farkas farkas;
  for (Eigen::Index i = 0; i < y.size(); ++i) farkas.add_row(y[i] * program.tau_d[i]);
  const auto add = [&](const auto& matrix, double sign, Eigen::Index j, double low, double high) {
    TermSum slope;
    for (Eigen::Index i = 0; i < y.size(); ++i) slope.add(sign * matrix(i, j) * y[i]);
    farkas.add_column(slope, low, high);
  };
  for (int j = 0; j < set.actuators(); ++j) add(set.B, 1, j, set.u_min[j], set.u_max[j]);
  for (int j = 0; j < program.columns(); ++j) {
    add(program.JtW, -1, j, program.w_min[j], program.w_max[j]);
  }
  return farkas.holds();
}

}  // namespace maxwrench
