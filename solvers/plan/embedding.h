#pragma once

#include "solvers/plan/directions.h"
#include "solvers/plan/forms.h"
#include "solvers/plan/forms_reader.h"
#include "solvers/plan/side.h"

namespace maxwrench {

/// The homogeneous self-dual embedding (Xu, Hung, Ye) of a plan program in its forms: with the
/// slacks s of the limits and multipliers y >= 0,
///
///     hi tau - phi(X) - s_hi = 0,  phi(X) - lo tau - s_lo = 0,  c tau = map'(y_hi - y_lo),
///     kappa = c'X - hi'y_hi + lo'y_lo,   s y = tau kappa = 0.
///
/// tau > 0 = kappa is an optimum at X/tau, kappa > 0 = tau a proof that there is none. Followed
/// from s y = mu by Mehrotra's predictor and corrector, with Gondzio's corrections of centrality
/// where they are cheap beside the factors.
class Embedding {
 public:
  enum class End { kVerdict, kNone, kNeedsRates, kNeedsSlacks };

  /// Without rates or slacks it ends as soon as these are needed. Counts on in
  /// `solution.iterations`; a verdict is one that the data confirm to `tolerance`.
  End run(const PlanProgram& program, bool rates, bool slacks, double tolerance,
          PlanSolution& solution);
  /// Why there is no verdict.
  const char* reason() const;

 private:
  void start(const PlanProgram& program);
  void measure(double step);
  void measure_equations();
  bool settled(const PlanProgram& program, double tolerance, PlanSolution& solution);
  void iterate();
  void predict();
  void aim_tau();
  void push(double share);
  void direct(double share, double tau_centre);
  void finish(double share, double tau_centre);
  void correct(double gamma);
  void centralise(double share, double tau_centre, double step);
  void refine(double share);
  double reach() const;

  bool split() const { return !forms_.slacks.empty(); }

  Forms forms_;
  FormsReader reader_;
  Side low_{-1}, high_{1};
  Directions D_;  ///< columns: of tau, of the step, of the residual of c tau
  Eigen::VectorXd X_, sigma_, phi_, phi_low_, scale_;
  Eigen::VectorXd kept_X_, kept_sigma_, kept_G_, kept_low_;
  double tau_ = 1, kappa_ = 1, d_tau_ = 0, d_kappa_ = 0, tau_pivot_ = 0;
  double least_pivot_ = 0;
  double mu_ = 0, rho_ = 0, count_ = 0, dual_value_ = 0, primal_value_ = 0, gap_residual_ = 0;
};

}  // namespace maxwrench
