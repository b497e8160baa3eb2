#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "maxwrench/linear_program.h"
#include "maxwrench/wrench_program.h"

/// @file
/// The linear program over all instants of a trajectory, and the interface of its solvers.

namespace maxwrench {

/// The lower level over all instants of a trajectory.
///
/// Its variables are blocks of efforts u_i (m) and wrenches w_i (k_i), i = 0 .. N - 1:
///
///     max t   subject to   B u_i - (J'W)_i w_i (+ s_i) = tau_d,i
///                          u_min <= u_i <= u_max (of the first: first_min, first_max)
///                          w_min,i <= w_i <= w_max,i
///                          |u_i+1 - u_i| <= du_max,i
///                          u_min <= u_i+1 + lag_i (u_i+1 - u_i) <= u_max where lag_i > 0
///                          t <= c_w,i'w_i for all i,  or with a peak p: t = c_w,p'w_p,
///                          or with `common`: t = c_w,i'w_i for all i
///
/// lag_i is the time constant T of a thruster divided by the time between the instants. An effort
/// that is linear between them follows, through a first-order lag, from the command u + T du/dt.
/// Between two instants the command is linear as well, and its end is the tighter one of both.
///
/// An instant without an objective (c_w,i zero or of no columns) is only balanced: it has no row of
/// t.
///
/// The elastic program has slacks s_i on the balance of the instants from `first_elastic` on. It
/// maximises t - rho sum |s_i|_1.
///
/// A list of scenarios is one program: the instants of its S scenarios one after another, each with
/// efforts and limits of its own, without rates from one scenario to the next, and with one t for
/// all.
///
/// A bordered program has additional variables y (p), for searches that move the postures in the
/// same linear program. The balance then contains + G_i y, with the constraints y_min <= y <= y_max
/// and r_min <= R y <= r_max.
struct TrajectoryProgram {
  /// Programs of the instants (N), all with the same B and N; those of one scenario have the same
  /// limits.
  std::vector<WrenchProgram> instants;
  int scenarios = 1;          ///< S, which divides N
  Eigen::VectorXd first_min,  ///< lower limits of u_0 (m), beside those of its scenario
      first_max;              ///< upper limits of u_0 (m), likewise
  /// Limits of the changes of efforts (m×(N-1)), infinite where there is none.
  Eigen::MatrixXd du_max;
  /// The lags (m×(N-1)) [-], 0 where the command equals the effort. Empty: all are 0.
  Eigen::MatrixXd lag;
  /// Instant p of the peak of an impulse, of which there is one scenario; -1: max-min. The peak of
  /// several scenarios is the only instant of each with an objective.
  int peak = -1;
  /// Whether one factor holds at all instants, such as the mass of a payload: t = c_w,i'w_i. It
  /// needs one wrench column at each instant, c_w other than zero, and no peak.
  bool common = false;
  double rho = kInfinity;  ///< weight of the slack, per N and N m; infinite: no slack
  int first_elastic = 0;   ///< the first instant of a scenario with slack

  std::vector<Eigen::MatrixXd> G;  ///< N matrices G_i (n×p); empty: no border
  Eigen::VectorXd y_min,           ///< lower limits of y (p)
      y_max;                       ///< upper limits of y (p)
  Eigen::SparseMatrix<double> R;   ///< matrix of the rows on y (rows×p)
  Eigen::VectorXd r_min,           ///< lower limits of R y (rows)
      r_max;                       ///< upper limits of R y (rows)

  /// Returns N, the number of instants.
  int size() const { return static_cast<int>(instants.size()); }
  /// Returns the number of instants of a scenario, N / S.
  int length() const { return size() / scenarios; }
  /// Returns whether the balance of instant i has slacks.
  bool slackens(int i) const { return elastic() && i % length() >= first_elastic; }
  /// Returns whether instant i has a row of t.
  bool bounds_value(int i) const {
    const Eigen::VectorXd& c_w = instants[static_cast<std::size_t>(i)].c_w;
    return peak < 0 && (common || (c_w.array() != 0).any());
  }
  /// Returns whether the command of effort j has limits at the end of the interval after instant i.
  bool lags(int j, int i) const { return lag.size() > 0 && lag(j, i) > 0; }
  /// Returns the lower limit of effort j at instant i.
  double u_min(int j, int i) const {
    const double own = instants[static_cast<std::size_t>(i)].actuation->u_min[j];
    if (i % length() != 0) return own;
    return scenarios == 1 ? first_min[j] : std::max(own, first_min[j]);
  }
  /// Returns the upper limit of effort j at instant i.
  double u_max(int j, int i) const {
    const double own = instants[static_cast<std::size_t>(i)].actuation->u_max[j];
    if (i % length() != 0) return own;
    return scenarios == 1 ? first_max[j] : std::min(own, first_max[j]);
  }
  /// Returns p, the number of variables y.
  int border() const { return static_cast<int>(y_min.size()); }
  /// Returns whether the program has slacks.
  bool elastic() const { return rho < kInfinity; }
};

/// The solution of a trajectory program, with its storage and its warm start.
struct TrajectorySolution : Verdict {
  double value = 0;                ///< value t, without the price of the slack
  double price = 0;                ///< price of the slack, rho sum |s_i|_1
  Eigen::MatrixXd u;               ///< efforts (m×N)
  std::vector<Eigen::VectorXd> w;  ///< wrench coordinates: N vectors (k_i)
  Eigen::MatrixXd s;               ///< slacks (n×N), zero unless elastic
  Eigen::VectorXd y;               ///< variables y (p)
  /// Multipliers of the balance (n×N): d value/d tau_d,i.
  ///
  /// If the program is infeasible, lambda, mu, kappa and nu are the proof instead, with `common`
  /// also pi.
  /// Then the supremum over the limits of
  ///
  ///     sum_i lambda_i'(B u_i - (J'W)_i w_i + G_i y) - mu'(rates) - kappa'(commands)
  ///       - nu'R y (+ pi_i c_w,i'w_i)
  ///
  /// is less than sum_i lambda_i'tau_d,i minus the contribution of the limits of rates, commands
  /// and rows.
  Eigen::MatrixXd lambda,
      mu,  ///< multipliers of the rates (m×(N-1)): positive where u_i+1 - u_i is at its upper limit
      kappa;  ///< multipliers of the commands (m×(N-1)), likewise; empty: the program has no lag
  /// Multipliers of t <= c_w,i'w_i (N). Their sum is one. With a peak they are the unit vector of
  /// the peak. With `common` they have any sign, and in a proof their sum is zero.
  Eigen::VectorXd pi,
      nu;              ///< multipliers of R y (rows): positive at r_max
  int iterations = 0;  ///< iterations of the solver
  Residual residual;   ///< residual of the solution
  std::vector<VariableState>
      basis;  ///< final basis, of a solver that stores one; empty: cold start
};

/// Returns whether a trajectory program is well formed.
///
/// It must have an instant, all sizes must agree, and all numbers must be finite. Limits may be
/// infinite on their own side, and rho may be infinite.
bool well_formed(const TrajectoryProgram& program);

/// Solves trajectory programs.
///
/// Use one object per thread. To add a solver, override `solve_well_formed`.
class TrajectorySolver {
 public:
  virtual ~TrajectorySolver() = default;
  /// Solves a program.
  ///
  /// The status is kNumericalError if the program is not `well_formed`.
  ///
  /// @param program   the program
  /// @param solution  on entry, the warm start, if its basis is not empty; on return, the result
  void solve(const TrajectoryProgram& program, TrajectorySolution& solution);
  /// Solves a program that is well formed, which `solve` checks. The arguments are those of
  /// `solve`.
  virtual void solve_well_formed(const TrajectoryProgram& program,
                                 TrajectorySolution& solution) = 0;
};

/// Returns a trajectory program as a linear program for general solvers.
LinearProgram assemble(const TrajectoryProgram& program);
/// Writes the numbers of a trajectory program into a linear program that `assemble` made for the
/// same shape. It allocates nothing.
void update(const TrajectoryProgram& program, LinearProgram& assembled);
/// Converts a solution of the assembled program.
///
/// @param program   the trajectory program
/// @param answer    the solution of the assembled program
/// @param solution  receives the solution of the trajectory program
void read(const TrajectoryProgram& program, const LpSolution& answer, TrajectorySolution& solution);

/// Computes the residual of a solution from the data of the program.
///
/// Balance: max |B u_i - (J'W)_i w_i + s_i + G_i y - tau_d,i|. Bounds: of u, w, y, rates, commands,
/// R y and of t <= c_w,i'w_i or t = c_w,i'w_i. Dual: in what has no limits, |lambda| in excess of
/// rho, and |1 - sum pi|. Gap: dual objective less (value - price). A number that cannot be
/// computed is infinite.
///
/// @param program   the program
/// @param solution  its solution
Residual recheck(const TrajectoryProgram& program, const TrajectorySolution& solution);

/// Returns whether lambda, mu, kappa, nu and with `common` pi prove that the program is infeasible,
/// by the criterion of `verified`.
bool proves_infeasible(const TrajectoryProgram& program, const TrajectorySolution& solution);

}  // namespace maxwrench
