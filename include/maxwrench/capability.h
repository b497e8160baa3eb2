#pragma once

#include "maxwrench/status.h"
#include "maxwrench/types.h"

namespace maxwrench {

/// What a measure says of one posture.
struct Capability : Verdict {
  double beta = 0;    ///< c'h [N or N m], or a score in a unit of its own
  Eigen::VectorXd w;  ///< k; empty and h zero if the measure says nothing of a wrench
  Vector6d h;  ///< W w (of the first contact), what the robot exerts on the environment, world axes
  Eigen::VectorXd u;  ///< m, actuator efforts; filled only when asked for, or empty
  /// n, d beta/d tau_d. Of an infeasible program instead a proof y: sup {y'(B u - J'W w)} < y'tau_d
  /// over the limits (Farkas; for the L2 polytope in the rows of its own program).
  Eigen::VectorXd lambda;
  /// d beta/d J (6×n). With lambda it carries the derivative to any parameter:
  /// d beta = lambda'd tau_d + <beta_J, d J> (envelope theorem; the paper's KKT gradient).
  Matrix6Xd beta_J;
  // With a second contact, else empty: what it exerts, world axes at the contact point, and
  // d beta/d J_2 (6×n), d beta/d C_2 (6×l). They join the sum d beta as <beta_J, d J> does.
  Vector6d h_2 = Vector6d::Zero();
  Matrix6Xd beta_J2, beta_C2;
  int iterations = 0;
  /// Filled together with u: balance max |B u - J'W w - tau_d| [N, N m]; bounds of u and w
  /// (ellipsoid: ||W_u u| - 1|); dual, on the columns without bounds; gap [N or N m]. An answer
  /// counts if they are within a tolerance times 1 + |beta|.
  Residual residual;

  /// No verdict, and zero in all numbers. Sizes stay, so that nothing is allocated again.
  void clear();
};

}  // namespace maxwrench
