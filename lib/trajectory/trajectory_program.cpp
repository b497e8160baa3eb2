#include "maxwrench/trajectory_program.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace maxwrench {
namespace {

/// The layout of the assembled program. Its columns are those of the instants, of the rates, of the
/// commands, t and the slack columns, y and the activities of R. Its rows are the balances, the
/// rates, the commands, those of t and of R.
class Layout {
 public:
  explicit Layout(const TrajectoryProgram& program)
      : program_(program),
        n_(program.instants.front().actuation->dimension()),
        m_(program.instants.front().actuation->actuators()) {
    for (int i = 0; i + 1 < program.size(); ++i) {
      for (int j = 0; j < m_; ++j) rates_ += program.du_max(j, i) < kInfinity;
      for (int j = 0; j < m_; ++j) commands_ += program.lags(j, i);
    }
    for (int i = 0; i < program.size(); ++i) t_rows_ += program.bounds_value(i);
  }

  int n() const { return n_; }
  int m() const { return m_; }
  int commands() const { return commands_; }
  bool max_min() const { return program_.peak < 0; }
  int t_rows() const { return t_rows_; }
  bool elastic(int i) const { return program_.slackens(i); }
  bool limited(int j, int i) const {
    return i >= 0 && i + 1 < program_.size() && program_.du_max(j, i) < kInfinity;
  }
  bool lags(int j, int i) const { return i >= 0 && i + 1 < program_.size() && program_.lags(j, i); }
  int columns(int i) const {
    return m_ + program_.instants[i].columns() + (elastic(i) ? 2 * n_ : 0);
  }
  int first_rate_row() const { return n_ * program_.size(); }
  int first_command_row() const { return first_rate_row() + rates_; }
  int first_t_row() const { return first_command_row() + commands_; }
  int first_r_row() const { return first_t_row() + t_rows_; }
  int r_rows() const { return static_cast<int>(program_.R.rows()); }
  int rows() const { return first_r_row() + r_rows(); }
  int cols() const {
    int count = rates_ + commands_ + (max_min() ? 1 : 0) + t_rows_ + program_.border() + r_rows();
    for (int i = 0; i < program_.size(); ++i) count += columns(i);
    return count;
  }

 private:
  const TrajectoryProgram& program_;
  int n_, m_;
  int rates_ = 0, commands_ = 0, t_rows_ = 0;
};

/// Calls sink.column(cost, low, high) for each column of the assembled program, then
/// sink.entry(row, value) for its entries in increasing rows. The pattern depends on the shape
/// alone.
template <class Sink>
class Walk {
 public:
  Walk(const TrajectoryProgram& program, Sink& sink)
      : program_(program), layout_(program), sink_(sink) {}

  void run() {
    for (int t_row = 0, i = 0; i < program_.size(); ++i) {
      instant(i, layout_.first_t_row() + t_row);
      t_row += program_.bounds_value(i);
    }
    for (int row = 0, i = 0; i + 1 < program_.size(); ++i) {
      for (int j = 0; j < layout_.m(); ++j) {
        if (!layout_.limited(j, i)) continue;
        sink_.column(0, -program_.du_max(j, i), program_.du_max(j, i));
        sink_.entry(layout_.first_rate_row() + row++, -1);
      }
    }
    for (int row = 0, i = 0; layout_.commands() > 0 && i + 1 < program_.size(); ++i) {
      for (int j = 0; j < layout_.m(); ++j) {
        if (!layout_.lags(j, i)) continue;
        sink_.column(0, program_.u_min(j, i + 1), program_.u_max(j, i + 1));
        sink_.entry(layout_.first_command_row() + row++, -1);
      }
    }
    if (layout_.max_min()) lowest();
    for (int j = 0; j < program_.border(); ++j) border(j);
    for (int row = 0; row < layout_.r_rows(); ++row) {
      sink_.column(0, program_.r_min[row], program_.r_max[row]);
      sink_.entry(layout_.first_r_row() + row, -1);
    }
  }

 private:
  void instant(int i, int t_row) {
    const WrenchProgram& at = program_.instants[i];
    const int row = i * layout_.n();
    efforts(i, row);
    const bool peak = i == program_.peak;
    for (int j = 0; j < at.columns(); ++j) {
      sink_.column(peak ? at.c_w[j] : 0, at.w_min[j], at.w_max[j]);
      for (int r = 0; r < layout_.n(); ++r) sink_.entry(row + r, -at.JtW(r, j));
      if (program_.bounds_value(i)) sink_.entry(t_row, at.c_w[j]);
    }
    if (!layout_.elastic(i)) return;
    for (const double sign : {1.0, -1.0}) {
      for (int r = 0; r < layout_.n(); ++r) {
        sink_.column(-program_.rho, 0, kInfinity);
        sink_.entry(row + r, sign);
      }
    }
  }

  void efforts(int i, int row) {
    const Zonotope& set = *program_.instants[i].actuation;
    int behind = layout_.first_rate_row() + rates_before_;
    int ahead = behind;
    for (int j = 0; j < layout_.m(); ++j) ahead += layout_.limited(j, i - 1);
    rates_before_ = ahead - layout_.first_rate_row();
    int command_behind = layout_.first_command_row() + commands_before_;
    int command_ahead = command_behind;
    for (int j = 0; j < layout_.m(); ++j) command_ahead += layout_.lags(j, i - 1);
    commands_before_ = command_ahead - layout_.first_command_row();
    for (int j = 0; j < layout_.m(); ++j) {
      sink_.column(0, program_.u_min(j, i), program_.u_max(j, i));
      for (int r = 0; r < layout_.n(); ++r) {
        if (set.B(r, j) != 0) sink_.entry(row + r, set.B(r, j));
      }
      if (layout_.limited(j, i - 1)) sink_.entry(behind++, 1);
      if (layout_.limited(j, i)) sink_.entry(ahead++, -1);
      if (layout_.lags(j, i - 1)) sink_.entry(command_behind++, 1 + program_.lag(j, i - 1));
      if (layout_.lags(j, i)) sink_.entry(command_ahead++, -program_.lag(j, i));
    }
  }

  /// The columns of t and of the excess of each c_w'w over t.
  void lowest() {
    sink_.column(1, -kInfinity, kInfinity);
    for (int i = 0; i < layout_.t_rows(); ++i) sink_.entry(layout_.first_t_row() + i, -1);
    for (int i = 0; i < layout_.t_rows(); ++i) {
      sink_.column(0, 0, program_.common ? 0 : kInfinity);
      sink_.entry(layout_.first_t_row() + i, -1);
    }
  }

  void border(int j) {
    sink_.column(0, program_.y_min[j], program_.y_max[j]);
    for (int i = 0; i < program_.size(); ++i) {
      for (int r = 0; r < layout_.n(); ++r) {
        sink_.entry(i * layout_.n() + r, program_.G[i](r, j));
      }
    }
    if (layout_.r_rows() == 0) return;
    for (Eigen::SparseMatrix<double>::InnerIterator it(program_.R, j); it; ++it) {
      sink_.entry(layout_.first_r_row() + static_cast<int>(it.row()), it.value());
    }
  }

  const TrajectoryProgram& program_;
  Layout layout_;
  Sink& sink_;
  int rates_before_ = 0, commands_before_ = 0;
};

struct Pattern {
  std::vector<Eigen::Triplet<double>> entries;
  int col = -1;
  void column(double /*cost*/, double /*low*/, double /*high*/) { ++col; }
  void entry(int row, double /*value*/) { entries.emplace_back(row, col, 0.0); }
};

struct Numbers {
  LinearProgram& lp;
  int col = 0;
  double* value;
  void column(double cost, double low, double high) {
    lp.c[col] = cost;
    lp.l[col] = low;
    lp.u[col++] = high;
  }
  void entry(int /*row*/, double number) { *value++ = number; }
};

bool is_finite(const Eigen::SparseMatrix<double>& R) {
  for (Eigen::Index col = 0; col < R.outerSize(); ++col) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(R, col); entry; ++entry) {
      if (!std::isfinite(entry.value())) return false;
    }
  }
  return true;
}

}  // namespace

bool well_formed(const TrajectoryProgram& program) {
  const int N = program.size();
  if (N == 0 || program.peak >= N || !(program.rho > 0)) return false;
  if (program.scenarios < 1 || N % program.scenarios != 0) return false;
  if (program.scenarios > 1 && program.peak >= 0) return false;
  if (program.common && program.peak >= 0) return false;
  const Zonotope* const set = program.instants.front().actuation;
  for (const WrenchProgram& at : program.instants) {
    if (at.actuation != set && !(at.actuation && at.actuation->B == set->B)) return false;
    if (!well_formed(at)) return false;
    if (program.common && (at.columns() != 1 || at.c_w[0] == 0)) return false;
  }
  const Eigen::Index m = set->actuators(), p = program.border(), rows = program.R.rows();
  const auto limits = [](const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                         Eigen::Index size) {
    return low.size() == size && high.size() == size && (low.array() < kInfinity).all() &&
           (high.array() > -kInfinity).all();
  };
  if (!limits(program.first_min, program.first_max, m)) return false;
  if (program.du_max.rows() != m || program.du_max.cols() != N - 1) return false;
  if (!(program.du_max.array() >= 0).all()) return false;
  if (program.lag.size() > 0) {
    if (program.lag.rows() != m || program.lag.cols() != N - 1) return false;
    if (!program.lag.allFinite() || !(program.lag.array() >= 0).all()) return false;
  }
  if (!limits(program.y_min, program.y_max, p) || !limits(program.r_min, program.r_max, rows)) {
    return false;
  }
  if (rows > 0 && (program.R.cols() != p || !is_finite(program.R))) return false;
  if (p > 0 && program.G.size() != program.instants.size()) return false;
  return std::all_of(program.G.begin(), program.G.end(), [&](const Eigen::MatrixXd& each) {
    return each.rows() == set->dimension() && each.cols() == p && each.allFinite();
  });
}

void TrajectorySolver::solve(const TrajectoryProgram& program, TrajectorySolution& solution) {
  if (well_formed(program)) return solve_well_formed(program, solution);
  solution.conclude(Status::kNumericalError, kMalformed);
}

LinearProgram assemble(const TrajectoryProgram& program) {
  assert(program.size() > 0);
  const Layout layout(program);
  LinearProgram lp;
  Pattern pattern;
  Walk<Pattern>(program, pattern).run();
  lp.A.resize(layout.rows(), layout.cols());
  lp.A.setFromTriplets(pattern.entries.begin(), pattern.entries.end());
  lp.b.setZero(layout.rows());
  lp.c.resize(layout.cols());
  lp.l.resize(layout.cols());
  lp.u.resize(layout.cols());
  update(program, lp);
  return lp;
}

void update(const TrajectoryProgram& program, LinearProgram& assembled) {
  Numbers numbers{assembled, 0, assembled.A.valuePtr()};
  Walk<Numbers>(program, numbers).run();
  assert(numbers.value == assembled.A.valuePtr() + assembled.A.nonZeros());
  const Eigen::Index n = program.instants.front().actuation->dimension();
  for (int i = 0; i < program.size(); ++i) {
    assembled.b.segment(i * n, n) = program.instants[i].tau_d;
  }
}

void read(const TrajectoryProgram& program, const LpSolution& answer,
          TrajectorySolution& solution) {
  const Layout layout(program);
  const int N = program.size();
  const bool proof = answer.status == Status::kInfeasible;
  solution.status = answer.status;
  solution.reason = answer.reason;
  solution.iterations = answer.iterations;
  const Eigen::VectorXd& rows = proof ? answer.certificate : answer.lambda;
  if (answer.status != Status::kOptimal && !proof) return;
  if (rows.size() != layout.rows()) return;
  // A proof is the y of the assembled program, in which mu and nu have the opposite sign.
  const double sign = proof ? -1 : 1;
  solution.lambda.resize(layout.n(), N);
  solution.mu.setZero(layout.m(), N - 1);
  solution.kappa.setZero(program.lag.rows(), program.lag.cols());
  solution.pi.setZero(N);
  for (int i = 0; i < N; ++i) solution.lambda.col(i) = rows.segment(i * layout.n(), layout.n());
  for (int row = layout.first_rate_row(), i = 0; i + 1 < N; ++i) {
    for (int j = 0; j < layout.m(); ++j) {
      if (layout.limited(j, i)) solution.mu(j, i) = sign * rows[row++];
    }
  }
  for (int row = layout.first_command_row(), i = 0; i + 1 < N; ++i) {
    for (int j = 0; j < layout.m(); ++j) {
      if (layout.lags(j, i)) solution.kappa(j, i) = sign * rows[row++];
    }
  }
  // The row c_w'w - t - z = b: raising b by one lowers the value by pi.
  for (int row = layout.first_t_row(), i = 0; i < N; ++i) {
    if (program.bounds_value(i)) solution.pi[i] = -sign * rows[row++];
  }
  if (!layout.max_min()) solution.pi[program.peak] = 1;
  solution.nu = sign * rows.tail(layout.r_rows());
  if (proof) return;
  solution.u.resize(layout.m(), N);
  solution.w.resize(N);
  solution.s.setZero(layout.n(), N);
  solution.price = 0;
  for (int col = 0, i = 0; i < N; ++i) {
    const int k = program.instants[i].columns();
    solution.u.col(i) = answer.x.segment(col, layout.m());
    solution.w[i] = answer.x.segment(col + layout.m(), k);
    col += layout.columns(i);
    if (!layout.elastic(i)) continue;
    const auto slacks = answer.x.segment(col - 2 * layout.n(), 2 * layout.n());
    solution.s.col(i) = slacks.head(layout.n()) - slacks.tail(layout.n());
    solution.price += program.rho * solution.s.col(i).lpNorm<1>();
  }
  solution.y =
      answer.x.segment(layout.cols() - layout.r_rows() - program.border(), program.border());
  const auto along = [&](int i) { return program.instants[i].c_w.dot(solution.w[i]); };
  solution.value = layout.max_min() ? kInfinity : along(program.peak);
  for (int i = 0; i < N; ++i) {
    if (program.bounds_value(i)) solution.value = std::min(solution.value, along(i));
  }
}

}  // namespace maxwrench
