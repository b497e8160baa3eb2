#pragma once

#include <memory>

#include "lib/status.h"
#include "lib/types.h"

namespace maxwrench {

struct Posture;
struct Robot;
struct WrenchProgram;
class WrenchSolver;

/// How well an answer satisfies its program, recomputed from the data.
struct Residual {
  double balance = 0;  ///< max |B u - J'W w - tau_d| [N, N m]
  double bounds = 0;   ///< how far u or w leave their limits (ellipsoid: ||W_u u| - 1|)
  double dual = 0;     ///< how far lambda is from dual feasible, on the columns without bounds
  double gap = 0;      ///< dual objective less beta: beta is optimal to within this [N or N m]
  /// Whether all are below `tolerance`, relative to 1 + |beta|.
  bool within(double tolerance, double beta) const;
};

/// What a measure says of one posture.
struct Capability {
  Status status = Status::kNumericalError;
  const char* reason = "";
  double beta = 0;    ///< N or N m, c'h
  Eigen::VectorXd w;  ///< k
  Vector6d h;         ///< W w, what the robot exerts on the environment, world axes
  Eigen::VectorXd u;  ///< m, actuator efforts; filled only when asked for
  /// n, d beta/d tau_d. Of an infeasible program instead a proof y: sup {y'(B u - J'W w)} < y'tau_d
  /// over the limits (Farkas; for the L2 polytope in the rows of its own program).
  Eigen::VectorXd lambda;
  /// d beta/d J (6×n). With lambda it carries the derivative to any parameter:
  /// d beta = lambda'd tau_d + <beta_J, d J> (envelope theorem; the paper's KKT gradient).
  Matrix6Xd beta_J;
  int iterations = 0;
  Residual residual;  ///< filled together with u
};

/// A scalar capability of a posture.
class Measure {
 public:
  virtual ~Measure() = default;
  /// `program` is that of the posture (JtW and tau_d set). Fills everything; u only if `efforts` is
  /// set.
  virtual void evaluate(const Posture& posture, const WrenchProgram& program, bool efforts,
                        Capability& capability) = 0;
};

/// beta_1: the positive root of eq:transmissionUVMS along c, and with free columns the farthest
/// point of that ellipsoid along c. Actuators are weighted by the smaller of their two absolute
/// limits. Throws std::invalid_argument if B has not full row rank or a limit is zero.
std::unique_ptr<Measure> make_ellipsoid(const Robot& robot);

/// The L2 polytope: u = B^+ (tau_d + J'h) within the limits. Throws std::invalid_argument if B has
/// not full row rank.
std::unique_ptr<Measure> make_l2_polytope(const Robot& robot, std::unique_ptr<WrenchSolver> solver);

/// The L-infinity polytope: any u within the limits that balances (beta_2, beta_3).
std::unique_ptr<Measure> make_linf_polytope(const Robot& robot,
                                            std::unique_ptr<WrenchSolver> solver);

}  // namespace maxwrench
