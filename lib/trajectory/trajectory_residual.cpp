#include <algorithm>
#include <cmath>

#include "lib/math/farkas.h"
#include "lib/math/raise_to.h"
#include "maxwrench/trajectory_program.h"

namespace maxwrench {
namespace {

/// A trajectory program and its multipliers, for both kinds of proof.
class Multipliers {
 public:
  Multipliers(const TrajectoryProgram& program, const TrajectorySolution& solution)
      : program_(program),
        solution_(solution),
        set_(*program.instants.front().actuation),
        n_(set_.dimension()),
        m_(set_.actuators()) {}

  /// Whether the multipliers that a proof needs have the right size and are finite.
  bool fit() const {
    const Eigen::Index N = program_.size();
    return solution_.lambda.rows() == n_ && solution_.lambda.cols() == N &&
           solution_.mu.rows() == m_ && solution_.mu.cols() == N - 1 &&
           solution_.nu.size() == program_.R.rows() && solution_.lambda.allFinite() &&
           solution_.mu.allFinite() && solution_.nu.allFinite() && kappa_fits();
  }

  bool elastic(int i) const { return program_.slackens(i); }

  /// Calls f(slope, low, high) for the columns u, w, rates, commands, y and R y, where slope is the
  /// coefficient in sign sum_i lambda_i'(B u_i - J'W w_i + G_i y) - mu'(rates) - kappa'(commands)
  /// - nu'(R y), without c_w.
  template <class F>
  void columns(double sign, F&& f) const {
    for (int i = 0; i < program_.size(); ++i) {
      for (int j = 0; j < m_; ++j)
        f(effort(sign, j, i), program_.u_min(j, i), program_.u_max(j, i));
      if (i + 1 == program_.size()) continue;
      for (int j = 0; j < m_; ++j) {
        f(one(solution_.mu(j, i)), -program_.du_max(j, i), program_.du_max(j, i));
      }
      for (int j = 0; j < m_; ++j) {
        if (!program_.lags(j, i)) continue;
        f(one(solution_.kappa(j, i)), program_.u_min(j, i + 1), program_.u_max(j, i + 1));
      }
    }
    for (int j = 0; j < program_.border(); ++j) {
      f(border(sign, j), program_.y_min[j], program_.y_max[j]);
    }
    for (int r = 0; r < program_.R.rows(); ++r) {
      f(one(solution_.nu[r]), program_.r_min[r], program_.r_max[r]);
    }
  }

  TermSum wrench(double sign, double c, int j, int i) const {
    TermSum slope = one(c);
    const Eigen::MatrixXd& JtW = program_.instants[i].JtW;
    for (int r = 0; r < n_; ++r) slope.add(-sign * solution_.lambda(r, i) * JtW(r, j));
    return slope;
  }

 private:
  bool kappa_fits() const {
    if (program_.lag.size() == 0) return true;
    return solution_.kappa.rows() == program_.lag.rows() &&
           solution_.kappa.cols() == program_.lag.cols() && solution_.kappa.allFinite();
  }

  static TermSum one(double value) {
    TermSum sum;
    sum.add(value);
    return sum;
  }

  TermSum effort(double sign, int j, int i) const {
    TermSum slope;
    for (int r = 0; r < n_; ++r) slope.add(sign * set_.B(r, j) * solution_.lambda(r, i));
    if (i > 0) slope.add(-solution_.mu(j, i - 1));
    if (i + 1 < program_.size()) slope.add(solution_.mu(j, i));
    if (i > 0 && program_.lags(j, i - 1)) {
      slope.add(-(1 + program_.lag(j, i - 1)) * solution_.kappa(j, i - 1));
    }
    if (i + 1 < program_.size() && program_.lags(j, i)) {
      slope.add(program_.lag(j, i) * solution_.kappa(j, i));
    }
    return slope;
  }

  TermSum border(double sign, int j) const {
    TermSum slope;
    for (int i = 0; i < program_.size(); ++i) {
      for (int r = 0; r < n_; ++r) slope.add(sign * program_.G[i](r, j) * solution_.lambda(r, i));
    }
    if (program_.R.rows() == 0) return slope;
    for (Eigen::SparseMatrix<double>::InnerIterator it(program_.R, j); it; ++it) {
      slope.add(-it.value() * solution_.nu[it.row()]);
    }
    return slope;
  }

  const TrajectoryProgram& program_;
  const TrajectorySolution& solution_;
  const Zonotope& set_;
  int n_, m_;
};

bool primal_fits(const TrajectoryProgram& program, const TrajectorySolution& solution) {
  const Zonotope& set = *program.instants.front().actuation;
  const int N = program.size();
  const bool sizes = solution.u.rows() == set.actuators() && solution.u.cols() == N &&
                     solution.s.rows() == set.dimension() && solution.s.cols() == N &&
                     solution.y.size() == program.border() &&
                     static_cast<int>(solution.w.size()) == N && solution.pi.size() == N;
  if (!sizes || !solution.u.allFinite() || !solution.s.allFinite()) return false;
  if (!solution.y.allFinite() || !solution.pi.allFinite()) return false;
  for (int i = 0; i < N; ++i) {
    if (solution.w[i].size() != program.instants[i].columns()) return false;
    if (!solution.w[i].allFinite()) return false;
  }
  return std::isfinite(solution.value) && std::isfinite(solution.price);
}

double worst_balance(const TrajectoryProgram& program, const TrajectorySolution& solution,
                     bool& price_is_right) {
  double worst = 0, price = 0;
  for (int i = 0; i < program.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    const bool elastic = program.slackens(i);
    for (Eigen::Index r = 0; r < at.tau_d.size(); ++r) {
      double sum = -at.tau_d[r] + solution.s(r, i);
      for (int j = 0; j < at.actuation->actuators(); ++j) {
        sum += at.actuation->B(r, j) * solution.u(j, i);
      }
      for (int j = 0; j < at.columns(); ++j) sum -= at.JtW(r, j) * solution.w[i][j];
      for (int j = 0; j < program.border(); ++j) sum += program.G[i](r, j) * solution.y[j];
      raise_to(worst, std::abs(sum));
      if (elastic) price += program.rho * std::abs(solution.s(r, i));
      if (!elastic) raise_to(worst, std::abs(solution.s(r, i)));
    }
  }
  price_is_right = std::abs(price - solution.price) <= 1e-9 * (1 + price);
  return worst;
}

double outside_limits(const TrajectoryProgram& program, const TrajectorySolution& solution) {
  double worst = 0;
  const auto check = [&](double x, double low, double high) {
    raise_to(worst, low - x);
    raise_to(worst, x - high);
  };
  for (int i = 0; i < program.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    const double along = at.c_w.dot(solution.w[i]);
    if (program.bounds_value(i) && !program.common) raise_to(worst, solution.value - along);
    if (program.peak == i || program.common) raise_to(worst, std::abs(solution.value - along));
    for (int j = 0; j < at.columns(); ++j) check(solution.w[i][j], at.w_min[j], at.w_max[j]);
    for (int j = 0; j < at.actuation->actuators(); ++j) {
      check(solution.u(j, i), program.u_min(j, i), program.u_max(j, i));
      if (i == 0) continue;
      const double most = program.du_max(j, i - 1);
      const double change = solution.u(j, i) - solution.u(j, i - 1);
      check(change, -most, most);
      if (!program.lags(j, i - 1)) continue;
      check(solution.u(j, i) + program.lag(j, i - 1) * change, program.u_min(j, i),
            program.u_max(j, i));
    }
  }
  for (int j = 0; j < program.border(); ++j) {
    check(solution.y[j], program.y_min[j], program.y_max[j]);
  }
  for (int r = 0; r < program.R.rows(); ++r) raise_to(worst, program.r_min[r] - program.r_max[r]);
  return worst;
}

/// The largest violation of the limits of R y. `activity` is storage for R y.
double outside_rows(const TrajectoryProgram& program, const TrajectorySolution& solution) {
  double worst = 0;
  if (program.R.rows() == 0) return worst;
  thread_local Eigen::VectorXd activity;
  activity.setZero(program.R.rows());
  for (int j = 0; j < program.border(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(program.R, j); it; ++it) {
      activity[it.row()] += it.value() * solution.y[j];
    }
  }
  for (Eigen::Index r = 0; r < activity.size(); ++r) {
    raise_to(worst, program.r_min[r] - activity[r]);
    raise_to(worst, activity[r] - program.r_max[r]);
  }
  return worst;
}

void add_dual(const TrajectoryProgram& program, const TrajectorySolution& solution,
              const Multipliers& data, Residual& residual) {
  double objective = 0;
  const auto add = [&](const TermSum& slope, double low, double high) {
    if (std::abs(slope.value) <= kRounding * slope.magnitudes) return;
    const double end = slope.value > 0 ? high : low;
    if (std::abs(end) < kInfiniteBound) {
      objective += slope.value * end;
    } else {
      raise_to(residual.dual, std::abs(slope.value));
    }
  };
  data.columns(-1, add);
  double sum = 0;
  for (int i = 0; i < program.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    objective += solution.lambda.col(i).dot(at.tau_d);
    sum += solution.pi[i];
    if (!program.common) raise_to(residual.dual, -solution.pi[i]);
    if (program.peak >= 0) raise_to(residual.dual, std::abs(solution.pi[i] - (program.peak == i)));
    if (program.peak < 0 && !program.bounds_value(i)) {
      raise_to(residual.dual, std::abs(solution.pi[i]));
    }
    for (int j = 0; j < at.columns(); ++j) {
      add(data.wrench(-1, solution.pi[i] * at.c_w[j], j, i), at.w_min[j], at.w_max[j]);
    }
    if (!data.elastic(i)) continue;
    raise_to(residual.dual, solution.lambda.col(i).lpNorm<Eigen::Infinity>() - program.rho);
  }
  raise_to(residual.dual, std::abs(1 - sum));
  residual.gap = 0;
  raise_to(residual.gap, std::abs(objective - (solution.value - solution.price)));
}

/// Whether limits exclude each other. This proves infeasibility without multipliers.
bool limits_cross(const TrajectoryProgram& program) {
  const auto crosses = [](const auto& low, const auto& high) {
    return (low.array() > high.array()).any();
  };
  for (int i = 0; i < program.size(); ++i) {
    for (int j = 0; j < program.instants.front().actuation->actuators(); ++j) {
      if (program.u_min(j, i) > program.u_max(j, i)) return true;
    }
  }
  if (program.du_max.size() > 0 && (program.du_max.array() < 0).any()) return true;
  if (crosses(program.y_min, program.y_max)) return true;
  if (program.R.rows() > 0 && crosses(program.r_min, program.r_max)) return true;
  return std::any_of(program.instants.begin(), program.instants.end(),
                     [&](const WrenchProgram& at) { return crosses(at.w_min, at.w_max); });
}

}  // namespace

Residual recheck(const TrajectoryProgram& program, const TrajectorySolution& solution) {
  Residual residual{kInfinity, kInfinity, kInfinity, kInfinity};
  const Multipliers data(program, solution);
  if (!primal_fits(program, solution)) return residual;
  bool price_is_right = false;
  residual.balance = worst_balance(program, solution, price_is_right);
  residual.bounds = std::max(outside_limits(program, solution), outside_rows(program, solution));
  if (!price_is_right || !data.fit()) return residual;
  residual.dual = 0;
  add_dual(program, solution, data, residual);
  return residual;
}

bool proves_infeasible(const TrajectoryProgram& program, const TrajectorySolution& solution) {
  if (limits_cross(program)) return true;
  const Multipliers data(program, solution);
  if (!data.fit() || (program.common && solution.pi.size() != program.size())) return false;
  if (program.common && !solution.pi.allFinite()) return false;
  Farkas farkas;
  TermSum factor;  // the slope of t, which has no limits
  data.columns(1, [&](const TermSum& slope, double low, double high) {
    farkas.add_column(slope, low, high);
  });
  for (int i = 0; i < program.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    for (Eigen::Index r = 0; r < at.tau_d.size(); ++r) {
      farkas.add_row(solution.lambda(r, i) * at.tau_d[r]);
    }
    for (int j = 0; j < at.columns(); ++j) {
      const double along = program.common ? solution.pi[i] * at.c_w[j] : 0;
      farkas.add_column(data.wrench(1, along, j, i), at.w_min[j], at.w_max[j]);
    }
    if (program.common) factor.add(-solution.pi[i]);
    if (!data.elastic(i)) continue;
    // The slack is unbounded, so its slope must be zero.
    for (Eigen::Index r = 0; r < at.tau_d.size(); ++r) {
      TermSum slope;
      slope.add(solution.lambda(r, i));
      farkas.add_column(slope, -kInfinity, kInfinity);
    }
  }
  farkas.add_column(factor, -kInfinity, kInfinity);
  return farkas.holds();
}

}  // namespace maxwrench
