#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "maxwrench/trajectory.h"

namespace maxwrench {

/// A whole trajectory as one nonlinear program in X = (x, t, u_i and w_i of all blocks), with x the
/// stacked knots:
///
///     max t (of an impulse c_w,p'w_p)   subject to
///     B u_i - J_i(x)'W_i(x) w_i - tau_d,i(x) = 0,   t - c_w,i'w_i <= 0,   the rates,   R x,
///     positions and rates of dependent joints (x)
///
/// and all limits. Only the balance and the last rows are nonlinear. Collisions are not included.
class JointProgram {
 public:
  /// Built at the trajectory that `trajectories` evaluated last by `evaluate_elastic`; keeps a
  /// reference.
  JointProgram(TrajectoryEvaluator& trajectories, const Eigen::VectorXd& x_min,
               const Eigen::VectorXd& x_max);

  /// X of that trajectory.
  const Eigen::VectorXd& start() const { return start_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  const Eigen::VectorXd& row_min() const { return row_min_; }
  const Eigen::VectorXd& row_max() const { return row_max_; }
  const Eigen::VectorXd& objective() const { return objective_; }  ///< linear, to be maximised
  /// The variables in which the rows are not linear: the knots and the wrenches.
  std::vector<int> nonlinear() const;
  auto knots(const Eigen::VectorXd& X) const { return X.head(p_); }

  /// Evaluates the rows at X and their derivative, whose pattern never changes.
  void evaluate(const Eigen::VectorXd& X);
  const Eigen::VectorXd& rows() const { return rows_; }
  const Eigen::SparseMatrix<double>& jacobian() const { return jacobian_; }

 private:
  int u0(int i) const { return first_[static_cast<std::size_t>(i)]; }
  int w0(int i) const { return u0(i) + m_; }
  void set_limits(const TrajectoryProgram& program, const KnotRows& rows,
                  const KnotRows& following);
  void fill(const TrajectoryProgram& program);
  void fill_block(const TrajectoryProgram& program, int i);
  void fill_linear(const TrajectoryProgram& program);
  void fill_rows(const Eigen::SparseMatrix<double>& R, int first);

  TrajectoryEvaluator& trajectories_;
  int p_, r_, m_, n_, N_;
  std::vector<int> first_;                           ///< of u_i
  std::vector<std::pair<int, int>> rated_, lagged_;  ///< (instant, effort) of rates and commands
  Eigen::VectorXd start_, lower_, upper_, row_min_, row_max_, objective_, rows_;
  std::vector<Eigen::VectorXd> w_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SparseMatrix<double> jacobian_;
};

}  // namespace maxwrench
