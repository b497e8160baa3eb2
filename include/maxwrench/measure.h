#pragma once

#include <memory>

#include "maxwrench/capability.h"

namespace maxwrench {

struct Posture;
class PostureEvaluator;
struct Problem;
struct Robot;
struct WrenchProgram;
class WrenchSolver;

/// A scalar capability of a posture.
class Measure {
 public:
  virtual ~Measure() = default;
  /// `program` is that of the posture (JtW and tau_d set). Fills everything; u only if `efforts` is
  /// set. Of a program that is not `well_formed`, or if the value is not finite, the status is
  /// kNumericalError, from any measure.
  void evaluate(const Posture& posture, const WrenchProgram& program, bool efforts,
                Capability& capability);
  /// Whether its value is the optimum of that program itself.
  virtual bool solves_program() const { return false; }

 private:
  /// Gets a `clear` capability: what it does not fill is zero, and the status kNumericalError.
  virtual void evaluate_well_formed(const Posture& posture, const WrenchProgram& program,
                                    bool efforts, Capability& capability) = 0;
};

/// The capability at theta_r: of the valid IK solutions of the second arm the one with the best
/// value, the first of equal ones; without a second contact there is one posture. `model` and the
/// posture stay on that IK solution, so its gradient is that of the IK solution: where the best IK
/// solution changes, beta has a kink, and where an IK solution ends (at a limit, a singularity or a
/// collision) it may jump. The capability is left alone if no posture is valid.
const Posture& evaluate_best(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                             Measure& measure, bool efforts, WrenchProgram& program,
                             Capability& capability);

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
