#pragma once

#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

/// @file
/// The result of a measure at one posture.

namespace maxwrench {

/// The numbers of a scenario in its list.
struct ScenarioChoice {
  int wrench = 0,          ///< index in `ScenarioList::wrenches`
      limits = 0;          ///< index in `ScenarioList::limits`
  std::vector<int> cases;  ///< for each load the index of its case
  /// The wrench per unit of beta in world axes at the posture; of a ball the critical one.
  Vector6d c = Vector6d::Zero();
};

/// The result of a measure at one posture.
///
/// The status is kOptimal, or the reason why there is no value.
struct Capability : Verdict {
  double beta = 0;    ///< c'h [N or N m], or a score or an acceleration in a unit of its own
  Eigen::VectorXd w;  ///< wrench coordinates (k); empty, with h zero, if the measure has no wrench
  Vector6d h;         ///< wrench W w of the first contact: what the robot exerts, in world axes
  Eigen::VectorXd u;  ///< actuator efforts (m); empty unless they were requested
  /// Derivative d beta/d tau_d (n).
  ///
  /// If the program is infeasible, it holds a proof y instead: sup {y'(B u - J'W w)} < y'tau_d over
  /// the limits (Farkas; for the L2 polytope in the rows of its own program).
  Eigen::VectorXd lambda;
  /// Derivative d beta/d J (6×n).
  ///
  /// Together with lambda it gives the derivative by any parameter (envelope theorem; the paper's
  /// KKT gradient), where `<.,.>` sums the products of the entries:
  ///
  ///     d beta = lambda'd tau_d + <beta_J, d J>
  Matrix6Xd beta_J;
  /// Derivative d beta/d q (all joints) at constant tau_d and J; empty if the measure depends on
  /// the posture through these two alone.
  ///
  /// It adds `beta_q'd q` to d beta. Measures of accelerations have it, because M depends on q.
  Eigen::VectorXd beta_q;
  /// Wrench of the second contact, in world axes at the contact point; zero without one.
  Vector6d h_2 = Vector6d::Zero();
  /// Derivative d beta/d J_2 (6×n) of a second contact; empty without one.
  ///
  /// It adds `<beta_J2, d J_2>` to d beta.
  Matrix6Xd beta_J2,
      /// Derivative d beta/d C_2 (6×l) of a second contact; empty without one.
      ///
      /// It adds `<beta_C2, d C_2>` to d beta.
      beta_C2;
  /// The scenario that decides, if the task has a list of scenarios: the first with the least upper
  /// end. w, h, u, lambda and the residual are its own.
  ScenarioChoice decides;
  int iterations = 0;  ///< iterations of the solver
  /// The residual of the result, filled together with u.
  ///
  /// Balance: max |B u - J'W w - tau_d| [N, N m]; of an acceleration that of its equation of
  /// motion. Bounds: violations by u and w (ellipsoid:
  /// ||W_u u| - 1|). Dual: violations in the columns without bounds. Gap: [N or N m]. A result
  /// counts if all four are within a tolerance times 1 + |beta|.
  Residual residual;

  /// Sets all numbers to zero and the status to kNumericalError.
  ///
  /// It keeps the sizes, so that later results allocate nothing.
  void clear();
};

}  // namespace maxwrench
