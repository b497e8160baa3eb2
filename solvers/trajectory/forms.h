#pragma once

#include <vector>

#include "lib/math/farkas.h"
#include "maxwrench/trajectory_program.h"
#include "solvers/trajectory/blocks.h"

namespace maxwrench {

/// A trajectory program as linear forms of free variables, between limits:
///
///     max c'X   subject to   lo <= phi(X) <= hi,
///
/// without equations. X = (x_0 .. x_N-1, z), z = (t, y), t only for max-min. The balance of a hard
/// instant is solved by B^+: x = (w, v) and u = B^+ (tau_d + J'W w - G y) + Z v, Z a basis of the
/// null space of B. What B does not reach is an equation on w and y: a form with lo = hi. Of an
/// elastic instant x = (s, w, v), its slacks s are taken from tau_d, and they are forms that cost
/// rho |s|: what weighs most in the end is a diagonal block.
///
/// Most programs of trajectories have an answer within their rates and without slack even if
/// neither is asked for: each may be left out, and the answer without is one with (`keeps_rates`).
///
/// Forms of an instant, phi = F x + D y (less t in the last one): efforts, those with rates first;
/// the one w in the place of efforts that nothing else moves; w with limits; slacks or equations;
/// c_w'w - t >= 0. Then follow the rates, which are differences of the instants' first forms, y,
/// and R y. Constant parts are in lo and hi.
struct Forms {
  void build(const TrajectoryProgram& program, bool with_rates = true, bool with_slacks = true);

  int N = 0;
  int t = 0;      ///< 1 for max-min
  int p = 0;      ///< y
  int rated = 0;  ///< actuators with a rate limit somewhere
  int size = 0;   ///< of all forms
  int variables = 0;
  int rates0 = 0, border0 = 0;  ///< the first rate, the first of y
  struct Stage {
    int d = 0, x0 = 0;        ///< variables
    int count = 0, f0 = 0;    ///< forms
    int F0 = 0;               ///< in `F`
    int efforts = 0;          ///< forms of efforts
    int w0 = 0, w_count = 0;  ///< forms of limits of w, from f0 on
    int w = 0;                ///< where w begins in x
    bool elastic = false;
    /// Where one form w takes the place of all efforts that only the single w moves: the rows in
    /// `order` of those that limit it; -1 otherwise. It follows the other efforts.
    int lowest = -1, highest = -1;
    bool merged() const { return highest >= 0; }
  };
  std::vector<Stage> stages;
  Eigen::VectorXd F;                   ///< count×d of each stage, by columns
  RowMatrix D;                         ///< border0×p, of the instants' forms and the rates
  Eigen::VectorXd lo, hi;              ///< zero where infinite
  Eigen::VectorXd has_lo, has_hi;      ///< 1 or 0; both zero: an equation phi = hi
  Eigen::VectorXd scale;               ///< a guess of how far phi is from its limits
  Eigen::VectorXd cost;                ///< c
  std::vector<int> slacks, equations;  ///< forms of these kinds
  std::vector<int> order;              ///< actuators, rated ones first, lone ones last
  int lone = 0;                        ///< without rates, and not moved by the null space of B
  const Eigen::SparseMatrix<double>* R = nullptr;  ///< the program's

  Eigen::Map<const Eigen::MatrixXd> F_of(const Stage& at) const {
    return {F.data() + at.F0, at.count, at.d};
  }
  int z0() const { return variables - p - t; }

  /// phi = phi(X), without constant parts, column by column.
  void apply(const Columns& X, Columns phi) const;
  /// X += the transposed map of g; uses g's storage.
  void add_transposed(Columns g, Columns X) const;

  /// Whether the efforts at X (phi = phi(X)) keep the rates.
  bool keeps_rates(const TrajectoryProgram& program, const Eigen::VectorXd& phi, double tau) const;
  /// u, w, s, y, value and price.
  void read_primal(const TrajectoryProgram& program, const Eigen::VectorXd& X, double tau,
                   TrajectorySolution& solution) const;
  /// lambda, mu, pi and nu from the forms' multipliers (positive at hi), divided by tau; with
  /// `proof` as in a proof of infeasibility. What rounding would leave on w, which may have no
  /// limits to pay for it, is taken from lambda.
  void read_dual(const TrajectoryProgram& program, const Eigen::VectorXd& multipliers, double tau,
                 bool proof, TrajectorySolution& solution);

 private:
  void shape(const TrajectoryProgram& program, bool with_rates, bool with_slacks);
  void order_actuators(const TrajectoryProgram& program, bool with_rates);
  void merge(const TrajectoryProgram& program, int i);
  double end_of_w(const TrajectoryProgram& program, int i, int r, bool high) const;
  double effort_multiplier(const Eigen::VectorXd& multipliers, int i, int r) const;
  void fill(const TrajectoryProgram& program);
  void fill_stage(const TrajectoryProgram& program, int i);
  void fill_efforts(const TrajectoryProgram& program, int i);
  void fill_unreached(const TrajectoryProgram& program, int i);
  void fill_rates(const TrajectoryProgram& program);
  void fill_border(const TrajectoryProgram& program);
  void level(const TrajectoryProgram& program, const Eigen::VectorXd& multipliers, double tau,
             int i, TrajectorySolution& solution);
  void sign_proof(TrajectorySolution& solution) const;
  void limit(int form, double low, double high, double offset);
  static bool has_limits(const WrenchProgram& at, int j) {
    return at.w_min[j] > -kInfiniteBound || at.w_max[j] < kInfiniteBound;
  }
  const Eigen::VectorXd& u_min(const TrajectoryProgram& program, int i) const {
    return i == 0 ? program.first_min : actuation_->u_min;
  }
  const Eigen::VectorXd& u_max(const TrajectoryProgram& program, int i) const {
    return i == 0 ? program.first_max : actuation_->u_max;
  }

  const Zonotope* actuation_ = nullptr;
  Eigen::MatrixXd B_;                   ///< of which Z_ and P_ are
  Eigen::MatrixXd Z_, P_;               ///< m×(m - rank), n×(n - rank)
  Eigen::MatrixXd B_pinv_, Z_ordered_;  ///< with rows in the order of the forms
  Eigen::MatrixXd offsets_;             ///< B^+ tau_d, m×N
  Eigen::MatrixXd slopes_;              ///< by the one w of an instant, m×N in order of the forms
  Eigen::MatrixXd gram_;
  Eigen::VectorXd slope_;
};

}  // namespace maxwrench
