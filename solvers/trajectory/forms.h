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
/// null space of B. The directions that B does not reach give equations on w and y: forms with lo =
/// hi. An elastic instant has x = (s, w, v). Its slacks s are subtracted from tau_d, and they are
/// forms that cost rho |s|; so the largest weights at the end form a diagonal block.
///
/// With a lag, the efforts of the rates also have forms of their commands, for each pair of
/// instants (1 + lag) phi_i+1 - lag phi_i after all rates. They are left out with the rates.
///
/// For most programs of trajectories, the answer of the program without rates or slacks satisfies
/// the rates and needs no slack. So each may be left out, and the answer without them is valid for
/// the whole program if it satisfies them (`keeps_rates`).
///
/// The forms of an instant, phi = F x + D y (less t in the last one), are: efforts, those with
/// rates first; the single w in place of the efforts that only w moves; w with limits; slacks or
/// equations; c_w'w - t >= 0, or = 0 with `common`. Then follow the rates, which are differences of
/// the instants' first forms, the commands, then y and R y. Constant parts are in lo and hi.
struct Forms {
  void build(const TrajectoryProgram& program, bool with_rates = true, bool with_slacks = true);

  int N = 0;
  int t = 0;            ///< 1 for max-min: whether z has t
  int p = 0;            ///< y
  int rated = 0;        ///< actuators with a rate limit or a lag at any instant
  bool lagged = false;  ///< whether there are forms of commands
  int size = 0;         ///< number of all forms
  int variables = 0;
  int rates0 = 0, commands0 = 0, border0 = 0;  ///< the first rate, command, and the first of y
  struct Stage {
    int d = 0, x0 = 0;        ///< number of variables and the first of them
    int count = 0, f0 = 0;    ///< number of forms and the first of them
    int F0 = 0;               ///< in `F`
    int efforts = 0;          ///< number of effort forms
    int w0 = 0, w_count = 0;  ///< forms of limits of w, from f0 on
    int w = 0;                ///< index of the first w in x
    bool elastic = false;
    bool has_t = false;  ///< whether its last form is c_w'w - t
    /// If one form w replaces all efforts that only the single w moves: the rows in `order` of the
    /// two that limit it; otherwise -1. The form comes after the other efforts.
    int lowest = -1, highest = -1;
    bool merged() const { return highest >= 0; }
  };
  std::vector<Stage> stages;
  Eigen::VectorXd F;                   ///< count×d of each stage, by columns
  RowMatrix D;                         ///< border0×p, of the instants' forms, rates and commands
  Eigen::MatrixXd lag;                 ///< rated×(N-1), if there are forms of commands
  Eigen::VectorXd lo, hi;              ///< zero where infinite
  Eigen::VectorXd has_lo, has_hi;      ///< 1 or 0; if both are zero, an equation phi = hi
  Eigen::VectorXd scale;               ///< estimated distance of phi from its limits
  Eigen::VectorXd cost;                ///< c
  std::vector<int> slacks, equations;  ///< forms of these kinds
  std::vector<int> order;              ///< actuators, rated ones first, lone ones last
  int lone = 0;  ///< actuators without rates that the null space of B does not move
  const Eigen::SparseMatrix<double>* R = nullptr;  ///< the program's

  Eigen::Map<const Eigen::MatrixXd> F_of(const Stage& at) const {
    return {F.data() + at.F0, at.count, at.d};
  }
  int z0() const { return variables - p - t; }

  /// phi = phi(X), without constant parts, column by column.
  void apply(const Columns& X, Columns phi) const;
  /// X += transposed map of g; overwrites g.
  void add_transposed(Columns g, Columns X) const;

  /// Whether the efforts at X (phi = phi(X)) satisfy the rates and the limits of commands.
  bool keeps_rates(const TrajectoryProgram& program, const Eigen::VectorXd& phi, double tau) const;
  /// Sets u, w, s, y, value and price.
  void read_primal(const TrajectoryProgram& program, const Eigen::VectorXd& X, double tau,
                   TrajectorySolution& solution) const;
  /// Sets lambda, mu, pi and nu from the forms' multipliers (positive at hi), divided by tau; with
  /// `proof`, in the form of a proof of infeasibility. Rounding would leave a slope on w, which may
  /// have no limits to bound it; lambda is corrected for it.
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
  void fill_commands(const TrajectoryProgram& program);
  void fill_border(const TrajectoryProgram& program);
  void level(const TrajectoryProgram& program, const Eigen::VectorXd& multipliers, double tau,
             int i, TrajectorySolution& solution);
  void sign_proof(TrajectorySolution& solution) const;
  void limit(int form, double low, double high, double offset);
  static bool has_limits(const WrenchProgram& at, int j) {
    return at.w_min[j] > -kInfiniteBound || at.w_max[j] < kInfiniteBound;
  }

  const Zonotope* actuation_ = nullptr;
  Eigen::MatrixXd B_;                   ///< the B from which Z_ and P_ were computed
  Eigen::MatrixXd Z_, P_;               ///< m×(m - rank), n×(n - rank)
  Eigen::MatrixXd B_pinv_, Z_ordered_;  ///< with rows in the order of the forms
  Eigen::MatrixXd offsets_;             ///< B^+ tau_d, m×N
  Eigen::MatrixXd slopes_;              ///< by the one w of an instant, m×N in order of the forms
  Eigen::MatrixXd gram_;
  Eigen::VectorXd slope_;
};

}  // namespace maxwrench
