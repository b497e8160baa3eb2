#include "solvers/search/joint_program.h"

#include <numeric>

namespace maxwrench {

JointProgram::JointProgram(TrajectoryEvaluator& trajectories, const Eigen::VectorXd& x_min,
                           const Eigen::VectorXd& x_max)
    : trajectories_(trajectories),
      p_(static_cast<int>(x_min.size())),
      r_(p_ / trajectories.knots()) {
  const TrajectorySolution& trajectory = trajectories.elastic_solution();
  w_ = trajectory.w;
  const Eigen::VectorXd x = stacked(trajectories.trajectory().knots);
  const TrajectoryProgram& program = trajectories.linearize();
  m_ = program.instants.front().actuation->actuators();
  n_ = program.instants.front().actuation->dimension();
  N_ = program.size();
  int next = p_ + 1;
  for (const WrenchProgram& at : program.instants) {
    first_.push_back(next);
    next += m_ + at.columns();
  }
  start_.resize(next);
  start_ << x, trajectory.value, Eigen::VectorXd::Zero(next - p_ - 1);
  lower_ = Eigen::VectorXd::Constant(next, -kInfinity);
  upper_ = Eigen::VectorXd::Constant(next, kInfinity);
  lower_.head(p_) = x_min;
  upper_.head(p_) = x_max;
  objective_.setZero(next);
  for (int i = 0; i < N_; ++i) {
    start_.segment(u0(i), m_) = trajectory.u.col(i);
    start_.segment(w0(i), w_[static_cast<std::size_t>(i)].size()) = w_[static_cast<std::size_t>(i)];
  }
  set_limits(program, trajectories.rows(), trajectories.dependent_rows());
  evaluate(start_);
}

void JointProgram::set_limits(const TrajectoryProgram& program, const KnotRows& rows,
                              const KnotRows& following) {
  Eigen::Index limits = 0;
  for (int i = 0; i < N_; ++i) {
    const WrenchProgram& at = program.instants[static_cast<std::size_t>(i)];
    limits += program.bounds_value(i);
    for (int j = 0; j < m_; ++j) {
      lower_[u0(i) + j] = program.u_min(j, i);
      upper_[u0(i) + j] = program.u_max(j, i);
    }
    lower_.segment(w0(i), at.columns()) = at.w_min;
    upper_.segment(w0(i), at.columns()) = at.w_max;
    if (i + 1 == N_) break;
    for (int j = 0; j < m_; ++j) {
      if (program.du_max(j, i) < kInfinity) rated_.emplace_back(i, j);
      if (program.lags(j, i)) lagged_.emplace_back(i, j);
    }
  }
  const bool path = program.peak < 0;
  if (path) {
    objective_[p_] = 1;
  } else {
    const WrenchProgram& at = program.instants[static_cast<std::size_t>(program.peak)];
    objective_.segment(w0(program.peak), at.columns()) = at.c_w;
    lower_[p_] = upper_[p_] = start_[p_] = 0;  // t is not used
  }
  const auto rates = static_cast<Eigen::Index>(rated_.size());
  const auto commands = static_cast<Eigen::Index>(lagged_.size());
  const Eigen::Index R = rows.R.rows(), F = following.R.rows();
  row_min_.setZero(n_ * N_ + limits + rates + commands + R + F);
  row_max_ = row_min_;
  if (!program.common) row_min_.segment(n_ * N_, limits).setConstant(-kInfinity);
  for (Eigen::Index k = 0; k < rates; ++k) {
    const auto& [i, j] = rated_[static_cast<std::size_t>(k)];
    row_max_[n_ * N_ + limits + k] = program.du_max(j, i);
    row_min_[n_ * N_ + limits + k] = -program.du_max(j, i);
  }
  for (Eigen::Index k = 0; k < commands; ++k) {
    const auto& [i, j] = lagged_[static_cast<std::size_t>(k)];
    row_max_[n_ * N_ + limits + rates + k] = program.u_max(j, i + 1);
    row_min_[n_ * N_ + limits + rates + k] = program.u_min(j, i + 1);
  }
  row_min_.tail(R + F) << rows.r_min, following.r_min;
  row_max_.tail(R + F) << rows.r_max, following.r_max;
}

std::vector<int> JointProgram::nonlinear() const {
  std::vector<int> variables(static_cast<std::size_t>(p_));
  std::iota(variables.begin(), variables.end(), 0);
  for (int i = 0; i < N_; ++i) {
    for (int j = 0; j < w_[static_cast<std::size_t>(i)].size(); ++j) {
      variables.push_back(w0(i) + j);
    }
  }
  return variables;
}

void JointProgram::evaluate(const Eigen::VectorXd& X) {
  for (int i = 0; i < N_; ++i) {
    Eigen::VectorXd& w = w_[static_cast<std::size_t>(i)];
    w = X.segment(w0(i), w.size());
  }
  const TrajectoryProgram& program =
      trajectories_.linearize(unstacked(X.head(p_), trajectories_.knots()), w_);
  fill(program);
  rows_.noalias() = jacobian_ * X;
  // The balance is not linear in the knots: tau_d replaces G times the knots.
  for (int i = 0; i < N_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    rows_.segment(n_ * i, n_) -= program.G[at] * X.head(p_) + program.instants[at].tau_d;
  }
  rows_.tail(trajectories_.dependent_rows().at.size()) = trajectories_.dependent_rows().at;
}

void JointProgram::fill(const TrajectoryProgram& program) {
  entries_.clear();
  for (int i = 0; i < N_; ++i) fill_block(program, i);
  fill_linear(program);
  jacobian_.resize(row_min_.size(), start_.size());
  jacobian_.setFromTriplets(entries_.begin(), entries_.end());
}

/// The balance of one instant. Zeros of B are not entries of the pattern; zeros of J'W and G are.
void JointProgram::fill_block(const TrajectoryProgram& program, int i) {
  const WrenchProgram& at = program.instants[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd& B = at.actuation->B;
  const Eigen::MatrixXd& G = program.G[static_cast<std::size_t>(i)];
  for (int row = 0; row < n_; ++row) {
    for (int j = 0; j < m_; ++j) {
      if (B(row, j) != 0) entries_.emplace_back(n_ * i + row, u0(i) + j, B(row, j));
    }
    for (int j = 0; j < at.columns(); ++j) {
      entries_.emplace_back(n_ * i + row, w0(i) + j, -at.JtW(row, j));
    }
    for (int j = 0; j < p_; ++j) entries_.emplace_back(n_ * i + row, j, G(row, j));
  }
}

void JointProgram::fill_linear(const TrajectoryProgram& program) {
  int row = n_ * N_;
  for (int i = 0; i < N_; ++i) {
    if (!program.bounds_value(i)) continue;
    const WrenchProgram& at = program.instants[static_cast<std::size_t>(i)];
    entries_.emplace_back(row, p_, 1);
    for (int j = 0; j < at.columns(); ++j) entries_.emplace_back(row, w0(i) + j, -at.c_w[j]);
    ++row;
  }
  for (const auto& [i, j] : rated_) {
    entries_.emplace_back(row, u0(i + 1) + j, 1);
    entries_.emplace_back(row++, u0(i) + j, -1);
  }
  for (const auto& [i, j] : lagged_) {
    entries_.emplace_back(row, u0(i + 1) + j, 1 + program.lag(j, i));
    entries_.emplace_back(row++, u0(i) + j, -program.lag(j, i));
  }
  fill_rows(trajectories_.rows().R, row);
  fill_rows(trajectories_.dependent_rows().R,
            row + static_cast<int>(trajectories_.rows().R.rows()));
}

/// The rows R x of the knots, from row `first` on.
void JointProgram::fill_rows(const Eigen::SparseMatrix<double>& R, int first) {
  for (int column = 0; column < R.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(R, column); it; ++it) {
      entries_.emplace_back(first + static_cast<int>(it.row()), column, it.value());
    }
  }
}

}  // namespace maxwrench
