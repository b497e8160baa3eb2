#pragma once

#include <memory>

#include "lib/status.h"
#include "lib/types.h"

namespace maxwrench {

struct Posture;
struct Problem;
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

// The measures of earlier work, which the paper's background tells of.

/// Yoshikawa's manipulability sqrt det(J J') [-] of the whole system: J maps base twist and joint
/// rates to the twist of the end effector, on the axes of W_any. Lengths are in units of 1 m, so
/// that 1 rad counts as much as 1 m, in the twist and in the velocities.
std::unique_ptr<Measure> make_manipulability(const Problem& problem);

/// The transmission ratio (c'J J'c)^(-1/2) [-]: how far the ellipsoid |J'h| <= 1 reaches along c, N
/// and N m counting alike; with free columns its farthest point along c. Throws
/// std::invalid_argument if B has not full row rank, as no efforts could be told.
std::unique_ptr<Measure> make_transmission_ratio(const Robot& robot);

/// eq:transmissionUVMS at tau_d = 0: |W_u B^+ J'h| <= 1. Throws as `make_ellipsoid`.
std::unique_ptr<Measure> make_weighted_transmission_ratio(const Robot& robot);

/// Minus the smallest sum of squared efforts u'u, u in N and N m, that balances c'h = reference of
/// the task, efforts without limits; with free columns the best of all such h. Throws
/// std::invalid_argument if B has not full row rank.
std::unique_ptr<Measure> make_least_effort(const Problem& problem);

/// The wrench along c at which the first actuator saturates, by the ratio of what its limit leaves
/// to what a unit of the wrench takes, as for a serial arm: there each joint has one effort for a
/// given wrench. Thrusters share theirs with the least |W_u u|; where all have the same limits,
/// this is the L2 polytope along c. Throws as `make_ellipsoid`.
std::unique_ptr<Measure> make_saturating_wrench(const Robot& robot);

/// The sum of the squared radii [-] of the ellipsoid |W_u B^+ J'h| <= 1 in the wrenches of W_any,
/// each axis measured by the task's desired wrench. Throws as `make_ellipsoid`.
std::unique_ptr<Measure> make_ellipsoid_trace(const Problem& problem);

}  // namespace maxwrench
