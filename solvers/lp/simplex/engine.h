#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "solvers/lp/makers.h"
#include "solvers/lp/simplex/factor.h"
#include "solvers/lp/simplex/model.h"

namespace maxwrench::simplex {

/// How one phase ended.
enum class Outcome { kDone, kInfeasible, kUnbounded, kIterationLimit, kTrouble };

/// The working state that both phases share. A basis is `head` (the variable at each position) and
/// a `state` for every variable. They determine x and d:
///
///   B x_B = b - N x_N,   B'y = cost_B,   d = cost - A'y.
///
/// `lower`, `upper` and `cost` are working copies that a phase may shift; the driver restores them.
class Engine {
 public:
  explicit Engine(const SimplexOptions& tolerances) : options(tolerances) {}

  void resize();
  void start_attempt();
  void reset_bounds_and_costs();
  /// Replaces logical variables of the basis by slacks and other columns with a single entry, then
  /// by free columns.
  void crash_basis();
  /// Factors the basis. Where it is singular, logical variables replace the dependent columns, and
  /// the result is false.
  bool refactor();
  void compute_primal();
  void compute_dual();
  /// One step of iterative refinement for x_B and y.
  void refine();
  void refine_primal();
  void refine_dual();

  double nonbasic_value(int j) const {
    if (state[j] == VariableState::kAtLower) return lower[j];
    return state[j] == VariableState::kAtUpper ? upper[j] : 0;
  }
  /// How far the basic variable at p is outside its bounds: 0 within tolerance, negative below the
  /// lower bound.
  double infeasibility(int p) const {
    const double x = x_basic[p], tolerance = basic_tolerance[p] + rounding;
    if (x < basic_lower[p] - tolerance) return x - basic_lower[p];
    if (x > basic_upper[p] + tolerance) return x - basic_upper[p];
    return 0;
  }
  /// Whether a violation in the tableau row `rho` exceeds what rounding of b could cause.
  bool provable(double violation) const;
  /// Tolerates the violation at p from now on.
  void excuse(int p, double violation);
  /// The part of the reduced cost of nonbasic j that has the wrong sign.
  double dual_violation(int j) const;
  bool primal_feasible() const;

  /// The column of variable j in terms of the basis, B^-1 a_j, into `z`.
  void column(int j, double* z);
  /// The row of B^-1 at position p into `y`.
  void inverse_row(int p, double* y);
  /// The same into `rho`, with a step of iterative refinement.
  void refined_inverse_row(int p);
  /// alpha_j = y'a_j for every nonbasic variable that may move.
  void tableau_row(const double* y);
  /// Variable q enters at position p; the leaving variable gets `leaving_state`.
  void pivot(int p, int q, VariableState leaving_state, double entering_value);

  /// Finds a basis with reduced costs of the right sign. Ends with the original bounds and costs.
  Outcome find_dual_feasible_basis();
  /// The two phases. They expect fresh factors, x and d.
  Outcome dual();
  Outcome primal();

  SimplexOptions options;
  Model model;
  Factor factor;
  std::vector<int> head;
  std::vector<VariableState> state;
  std::vector<double> lower, upper, cost;
  std::vector<double> x_basic, basic_lower, basic_upper, basic_tolerance;  // by positions
  // The errors that rounding alone can cause in a basic variable and in a reduced cost.
  double rounding = 0, dual_rounding = 0;
  std::vector<double> y, d;  // by rows, by variables
  std::vector<double> alpha_row, alpha_column, rho;
  int iterations = 0, iteration_limit = 0;
  bool perturb = true;  // whether to answer stalling by shifting bounds and costs
  bool bounds_shifted = false;
  // The basis of a verdict: the row and the bound that it violates, or the column and its
  // direction.
  int proof_position = -1, proof_column = -1;
  double proof_sign = 0;

 private:
  friend class Dual;
  friend class Primal;
  void enter_free_column(int j);
  void load_position(int p);
  VariableState finite_bound(int j) const;
  void tableau_row_by_rows(const double* y);
  double jitter(int j);

  std::vector<double> row_work_, position_work_, weights_, ratios_, excused_;
  bool homogeneous_ = false;  // whether b counts as zero
  std::vector<int> candidates_, flipped_, groups_;
  std::uint64_t random_ = 0;
};

}  // namespace maxwrench::simplex
