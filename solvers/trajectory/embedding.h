#pragma once

#include "solvers/trajectory/forms.h"
#include "solvers/trajectory/normal_matrix.h"
#include "solvers/trajectory/side.h"

namespace maxwrench {

/// The homogeneous self-dual embedding (Xu, Hung, Ye) of a trajectory program in its forms: with
/// the slacks s of the limits and multipliers y >= 0,
///
///     hi tau - phi(X) - s_hi = 0,  phi(X) - lo tau - s_lo = 0,  c tau = map'(y_hi - y_lo),
///     kappa = c'X - hi'y_hi + lo'y_lo,   s y = tau kappa = 0.
///
/// If tau > 0 = kappa, X/tau is an optimum; kappa > 0 = tau proves that there is none. The central
/// path s y = mu is followed by Mehrotra's predictor and corrector, with Gondzio's centrality
/// corrections where they are cheap compared with the factors.
class Embedding {
 public:
  enum class End { kVerdict, kNone, kNeedsRates, kNeedsSlacks };

  /// Without rates or slacks, it ends as soon as these are needed. Adds its iterations to
  /// `solution.iterations`. A verdict is one that the data confirm to `tolerance`.
  End run(const TrajectoryProgram& program, bool rates, bool slacks, double tolerance,
          TrajectorySolution& solution);
  /// Why there is no verdict.
  const char* reason() const;

 private:
  /// Columns of the directions: of tau, of the step without tau, and of the residual of c tau.
  static constexpr int kTau = 0, kStep = 1, kDual = 2;

  void start(const TrajectoryProgram& program);
  bool settled(const TrajectoryProgram& program, double tolerance, TrajectorySolution& solution);
  void collect_multipliers();
  void iterate();
  void predict();
  void eliminate_slacks(int first, int count);
  void solve_normal(int first, int count);
  void direct(double reduction, double tau_centre, double raise);
  void combine_directions(double reduction, double tau_centre, double rhs);
  void centralise(double reduction, double tau_centre);
  void refine(double reduction);
  double left() const;
  double reach() const;

  // Each makes one pass over all forms.
  void measure(double step);
  void advance(double step);
  void measure_equations();
  void measure_slacks();
  double affine_rhs();
  void predict_affine();
  double newton_rhs(double reduction, double raise);
  double sum_moves() const;
  void finish(double reduction);
  void add_change();

  bool split() const { return !forms_.slacks.empty(); }
  const Eigen::VectorXd& phi_low() const { return split() ? phi_low_ : phi_; }
  const Eigen::MatrixXd& G_low() const { return split() ? G_low_ : G_; }

  Forms forms_;
  NormalMatrix matrix_;
  Side low_{-1}, high_{1};
  /// X: variables; sigma: slacks; G: numbers of the forms, first those mapped to X, then phi of the
  /// solved X (less sigma for one side, plus sigma for the other).
  Eigen::MatrixXd D_X_, D_sigma_, G_, G_low_;
  Eigen::VectorXd X_, sigma_, phi_, phi_low_, weight_, s_phi_, s_diagonal_, scale_;
  Eigen::VectorXd kept_X_, kept_sigma_, kept_G_, kept_low_;
  Eigen::VectorXd equation_y_, equation_dy_;  ///< multipliers of any sign
  double tau_ = 1, kappa_ = 1, d_tau_ = 0, d_kappa_ = 0, tau_pivot_ = 0;
  double least_pivot_ = 0;
  double mu_ = 0, rho_ = 0, count_ = 0, dual_value_ = 0, primal_value_ = 0, gap_residual_ = 0;
  double falls_ = 0;  ///< the largest share of itself that an s or a y loses in a full step
};

}  // namespace maxwrench
