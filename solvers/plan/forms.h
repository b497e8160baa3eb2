#pragma once

#include <vector>

#include "maxwrench/plan_program.h"
#include "solvers/plan/blocks.h"

namespace maxwrench {

/// Whether w_j has a limit.
bool has_limits(const WrenchProgram& at, int j);

/// A plan program as linear forms of free variables, between limits:
///
///     max c'X   subject to   lo <= phi(X) <= hi,
///
/// without equations. X = (x_0 .. x_N-1, z), z = (t, y), t only for max-min. The balance of a hard
/// instant is solved by B^+: x = (w, v) and u = B^+ (tau_d + J'W w - G y) + Z v, Z a basis of the
/// null space of B. What B does not reach is an equation on w and y: a form with lo = hi. Of an
/// elastic instant x = (s, w, v), its slacks s are taken from tau_d, and they are forms that cost
/// rho |s|: what weighs most in the end is a diagonal block.
///
/// Most programs of plans have an answer within their rates and without slack even if neither is
/// asked for: each may be left out, and the answer without is one with (`keeps_rates`).
///
/// Forms of an instant, phi = F x + D y (less t in the last one): efforts, those with rates first;
/// w with limits; slacks or equations; c_w'w - t >= 0. Then follow the rates, which are differences
/// of the instants' first forms, y, and R y. Constant parts are in lo and hi.
struct Forms {
  void build(const PlanProgram& program, bool with_rates = true, bool with_slacks = true);

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
    int w0 = 0, w_count = 0;  ///< forms of limits of w, from f0 on
    int w = 0;                ///< where w begins in x
    bool elastic = false;
  };
  std::vector<Stage> stages;
  Eigen::VectorXd F;                   ///< count×d of each stage, by columns
  RowMatrix D;                         ///< border0×p, of the instants' forms and the rates
  Eigen::VectorXd lo, hi;              ///< zero where infinite
  Eigen::VectorXd has_lo, has_hi;      ///< 1 or 0; both zero: an equation phi = hi
  Eigen::VectorXd scale;               ///< a guess of how far phi is from its limits
  Eigen::VectorXd cost;                ///< c
  std::vector<int> slacks, equations;  ///< forms of these kinds
  std::vector<int> order;              ///< actuators, rated ones first
  const Eigen::SparseMatrix<double>* R = nullptr;  ///< the program's
  const Zonotope* actuation = nullptr;             ///< the program's
  Eigen::MatrixXd P;        ///< n×(n - rank), a basis of what B does not reach
  Eigen::MatrixXd offsets;  ///< B^+ tau_d, m×N

  Eigen::Map<const Eigen::MatrixXd> F_of(const Stage& at) const {
    return {F.data() + at.F0, at.count, at.d};
  }
  int z0() const { return variables - p - t; }

  /// phi = phi(X), without constant parts, column by column.
  void apply(const Columns& X, Columns phi) const;
  /// X += the transposed map of g; uses g's storage.
  void add_transposed(Columns g, Columns X) const;

  /// Whether the efforts at X (phi = phi(X)) keep the rates.
  bool keeps_rates(const PlanProgram& program, const Eigen::VectorXd& phi, double tau) const;

 private:
  void shape(const PlanProgram& program, bool with_rates, bool with_slacks);
  void order_actuators(const PlanProgram& program, bool with_rates);
  void fill(const PlanProgram& program);
  void fill_stage(const PlanProgram& program, int i);
  void fill_efforts(const PlanProgram& program, int i);
  void fill_unreached(const PlanProgram& program, int i);
  void fill_rates(const PlanProgram& program);
  void fill_border(const PlanProgram& program);
  void limit(int form, double low, double high, double offset);

  Eigen::MatrixXd B_;                   ///< of which Z_ and P are
  Eigen::MatrixXd Z_;                   ///< m×(m - rank)
  Eigen::MatrixXd B_pinv_, Z_ordered_;  ///< with rows in the order of the forms
};

}  // namespace maxwrench
