#pragma once

#include <limits>
#include <vector>

#include "maxwrench/linear_program.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// The lower level over the instants of a motion: blocks of u_i (m) and w_i (k_i), i = 0 .. N - 1,
///
///     max t   subject to   B u_i - (J'W)_i w_i (+ s_i) = tau_d,i
///                          u_min <= u_i <= u_max (of the first: first_min, first_max)
///                          w_min,i <= w_i <= w_max,i
///                          |u_i+1 - u_i| <= du_max,i
///                          t <= c_w,i'w_i for all i,  or with a peak p: t = c_w,p'w_p
///
/// The elastic program has slacks s_i on the balance of the instants from `first_elastic` on and
/// maximises t - rho sum |s_i|_1.
///
/// A bordered program has variables y (p) beside: + G_i y in the balance, y_min <= y <= y_max and
/// r_min <= R y <= r_max, for searches that move the postures in the same linear program.
struct TrajectoryProgram {
  std::vector<WrenchProgram> instants;   ///< all with the same actuation
  Eigen::VectorXd first_min, first_max;  ///< m
  Eigen::MatrixXd du_max;                ///< m×(N-1), infinite where there is no limit
  int peak = -1;                         ///< of an impulse; -1: max-min
  double rho = kInfinity;                ///< per N and N m; infinite: no slack
  int first_elastic = 0;

  std::vector<Eigen::MatrixXd> G;  ///< N of n×p; empty: no border
  Eigen::VectorXd y_min, y_max;    ///< p
  Eigen::SparseMatrix<double> R;   ///< rows×p
  Eigen::VectorXd r_min, r_max;

  int size() const { return static_cast<int>(instants.size()); }
  int border() const { return static_cast<int>(y_min.size()); }
  bool elastic() const { return rho < kInfinity; }
};

/// The answer, its storage and its warm start.
struct TrajectorySolution : Verdict {
  double value = 0;                ///< t, without the price of the slack
  double price = 0;                ///< rho sum |s_i|_1
  Eigen::MatrixXd u;               ///< m×N
  std::vector<Eigen::VectorXd> w;  ///< N of k_i
  Eigen::MatrixXd s;               ///< n×N, zero unless elastic
  Eigen::VectorXd y;               ///< p
  // Multipliers: of the balance n×N (d value/d tau_d,i), of the rates m×(N-1) (positive where
  // u_i+1 - u_i ends at its upper limit), of t <= c_w,i'w_i N (their sum is one; with a peak its
  // unit vector), and of R y (positive at r_max). Of an infeasible program lambda and mu are the
  // proof instead: sup {sum_i lambda_i'(B u_i - (J'W)_i w_i + G_i y) - mu'(rates) - nu'R y} over
  // the limits is below sum_i lambda_i'tau_d,i less what the rates' and rows' limits give.
  Eigen::MatrixXd lambda, mu;
  Eigen::VectorXd pi, nu;
  int iterations = 0;
  Residual residual;
  std::vector<VariableState> basis;  ///< of a solver that keeps one; empty: cold start
};

/// Whether there is an instant, all sizes agree, and all numbers are finite but for limits, which
/// may be infinite on their own side, and rho.
bool well_formed(const TrajectoryProgram& program);

/// Solves trajectory programs. Not shared between threads.
class TrajectorySolver {
 public:
  virtual ~TrajectorySolver() = default;
  /// Of a program that is not `well_formed` the status is kNumericalError, from any solver.
  void solve(const TrajectoryProgram& program, TrajectorySolution& solution);

 private:
  virtual void solve_well_formed(const TrajectoryProgram& program,
                                 TrajectorySolution& solution) = 0;
};

/// The same program for general solvers; `update` rewrites the numbers of one that `assemble` made
/// for the same shape and allocates nothing. `read` takes a trajectory solution from its answer.
LinearProgram assemble(const TrajectoryProgram& program);
void update(const TrajectoryProgram& program, LinearProgram& assembled);
void read(const TrajectoryProgram& program, const LpSolution& answer, TrajectorySolution& solution);

/// Recomputed from the data: balance max |B u_i - (J'W)_i w_i + s_i + G_i y - tau_d,i|; bounds of
/// u, w, y, rates, R y and of t <= c_w,i'w_i; dual, on what has no limits, |lambda| beyond rho, and
/// |1 - sum pi|; gap, dual objective less (value - price). What cannot be computed is infinite.
Residual recheck(const TrajectoryProgram& program, const TrajectorySolution& solution);

/// Whether lambda, mu and nu prove that the program has no answer, as `verified` judges it.
bool proves_infeasible(const TrajectoryProgram& program, const TrajectorySolution& solution);

}  // namespace maxwrench
