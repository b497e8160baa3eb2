#pragma once

#include <functional>
#include <memory>

#include "maxwrench/capability.h"

/// @file
/// The interface of capability measures, and the measures that are built in.

namespace maxwrench {

struct Posture;
class PostureEvaluator;
struct Problem;
struct Robot;
struct WrenchProgram;
class WrenchSolver;

/// A scalar capability of a posture.
///
/// To add a measure, override `evaluate_well_formed`.
class Measure {
 public:
  virtual ~Measure() = default;
  /// Evaluates the measure at a posture.
  ///
  /// The status is kNumericalError if the program is not `well_formed` or the value is not finite.
  ///
  /// @param posture     the posture
  /// @param program     the wrench program of this posture, with JtW and tau_d set
  /// @param efforts     whether to compute u and the residual
  /// @param capability  receives the result
  void evaluate(const Posture& posture, const WrenchProgram& program, bool efforts,
                Capability& capability);
  /// Evaluates the measure with a program that is well formed.
  ///
  /// `evaluate` checks the program and clears `capability` before: numbers that are not written
  /// remain zero, and the status remains kNumericalError unless it is set. Only if `solves_program`
  /// is true it does not clear. The arguments are those of `evaluate`.
  virtual void evaluate_well_formed(const Posture& posture, const WrenchProgram& program,
                                    bool efforts, Capability& capability) = 0;
  /// Computes the derivatives lambda, beta_J, beta_q, beta_J2 and beta_C2 of the last result.
  ///
  /// It is called only where a gradient is wanted, so a measure whose derivatives cost much more
  /// than its value can leave them to this function. The default does nothing: most measures fill
  /// the derivatives together with the value.
  ///
  /// @param posture     the posture of the last evaluation
  /// @param program     its wrench program
  /// @param capability  the result of the last evaluation, which has a value
  virtual void differentiate(const Posture& posture, const WrenchProgram& program,
                             Capability& capability);
  /// Returns whether the value is the optimum of the wrench program. If so,
  /// `evaluate_well_formed` must write all of the result.
  virtual bool solves_program() const { return false; }

 private:
  friend const Posture& evaluate_best(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                                      Measure& measure, bool efforts, WrenchProgram& program,
                                      Capability& capability);
  void evaluate_if(bool well_formed, const Posture& posture, const WrenchProgram& program,
                   bool efforts, Capability& capability);
};

/// Evaluates a measure at theta_r, at the valid IK solution with the largest value.
///
/// There may be several IK solutions with dependent joints or a second contact; otherwise there is
/// one. Of equal values the first counts. `model` stays on the chosen IK solution, so its gradient
/// belongs to this one. Where another IK solution becomes the best, beta has a kink. Where an IK
/// solution ends (at a limit, a singularity or a collision), beta may jump.
///
/// @param model       evaluates the postures
/// @param theta_r     the redundant coordinates (r)
/// @param measure     the measure
/// @param efforts     whether to compute u and the residual
/// @param program     made for this problem; receives the wrench program of the posture
/// @param capability  receives the result; unchanged if no posture is valid
/// @return the posture, which `model` owns
const Posture& evaluate_best(PostureEvaluator& model, const Eigen::VectorXd& theta_r,
                             Measure& measure, bool efforts, WrenchProgram& program,
                             Capability& capability);

/// Makes the ellipsoid measure, beta_1.
///
/// The value is the positive root of eq:transmissionUVMS along c. With free columns it is the
/// farthest point of that ellipsoid along c. The weight of an actuator uses the smaller of its two
/// absolute limits.
///
/// @throws std::invalid_argument if B does not have full row rank, or an actuator cannot act in
///         both directions (min < 0 < max).
std::unique_ptr<Measure> make_ellipsoid(const Robot& robot);

/// Makes the L2 polytope measure: the efforts u = B^+ (tau_d + J'h) must be within the limits.
///
/// @param robot   the robot
/// @param solver  solves the program
/// @throws std::invalid_argument if B does not have full row rank.
std::unique_ptr<Measure> make_l2_polytope(const Robot& robot, std::unique_ptr<WrenchSolver> solver);

/// Makes the L-infinity polytope measure (beta_2, beta_3): any u within the limits that satisfies
/// the balance is allowed.
///
/// @param robot   the robot
/// @param solver  solves the program
std::unique_ptr<Measure> make_linf_polytope(const Robot& robot,
                                            std::unique_ptr<WrenchSolver> solver);

/// Makes the L-infinity polytope measure of a task with a list of scenarios.
///
/// The value is that of `ScenarioList`. With facets, and one column in each wrench program, all
/// scenarios are scanned at once: each side of each pair of facets takes its own worst case of each
/// load, so their combinations do not count. Otherwise `solver` solves them one by one. In both
/// cases it solves the scenario that decides if efforts are requested.
///
/// @param problem  the task, which must outlive the measure
/// @param wrench   the allowed wrenches
/// @param solver   solves wrench programs
/// @param facets   whether to scan facets; ignored if the task does not permit it
/// @throws std::invalid_argument if the task has a ball, facets are not scanned, and the ball has
///         three axes or stands beside `c` or `set`.
std::unique_ptr<Measure> make_scenario_polytope(const Problem& problem, Wrench wrench,
                                                std::unique_ptr<WrenchSolver> solver, bool facets);

/// Makes a measure from a function that gives the value alone.
///
/// The derivatives by tau_d and J, with a second contact also by J_2 and C_2, are central
/// differences of the function, one-sided beside NaN. They cost two calls for each entry, 14 n
/// without a second contact, wherever a gradient is wanted; other searches do not need them. The
/// differences change nothing else: a value that also depends on `Posture::q`, on the base or on
/// the links has a gradient without that part. Choose a search without gradients for such a value.
///
/// @param value  returns the value at a posture with its wrench program, or NaN where there is
///               none (kInfeasible). Each thread calls a copy of it.
std::unique_ptr<Measure> make_value_measure(
    std::function<double(const Posture&, const WrenchProgram&)> value);

// Measures of earlier work, which the background of the paper describes.

/// Makes Yoshikawa's manipulability sqrt det(J J') [-] of the whole system.
///
/// J maps the base twist and joint rates to the twist of the end effector, on the axes of W_any.
/// Lengths are in units of 1 m, so that 1 rad counts as much as 1 m, in the twist and in the
/// velocities.
std::unique_ptr<Measure> make_manipulability(const Problem& problem);

/// Makes the transmission ratio (c'J J'c)^(-1/2) [-].
///
/// It is the extent of the ellipsoid |J'h| <= 1 along c, where N and N m count alike. With free
/// columns it is the farthest point of the ellipsoid along c.
///
/// @throws std::invalid_argument if B does not have full row rank, because the efforts would then
///         be undetermined.
std::unique_ptr<Measure> make_transmission_ratio(const Robot& robot);

/// Makes the weighted transmission ratio: eq:transmissionUVMS at tau_d = 0, |W_u B^+ J'h| <= 1.
///
/// @throws std::invalid_argument as `make_ellipsoid`.
std::unique_ptr<Measure> make_weighted_transmission_ratio(const Robot& robot);

/// Makes the least-effort measure: minus the smallest sum of squared efforts u'u.
///
/// u, in N and N m and without limits, satisfies the balance at c'h = `Problem::reference`. With
/// free columns the best such h counts.
///
/// @throws std::invalid_argument if B does not have full row rank.
std::unique_ptr<Measure> make_least_effort(const Problem& problem);

/// Makes the saturating-wrench measure: the wrench along c at which the first actuator saturates.
///
/// For each actuator it takes the ratio of the remaining effort to the effort per unit of wrench.
/// This is the method for serial arms, where a given wrench determines the effort of each joint.
/// Here the efforts are those of least |W_u u|. If all actuators have the same limits, the value is
/// that of the L2 polytope along c.
///
/// @throws std::invalid_argument as `make_ellipsoid`.
std::unique_ptr<Measure> make_saturating_wrench(const Robot& robot);

/// Makes the ellipsoid trace: the sum of the squared radii [-] of the ellipsoid |W_u B^+ J'h| <= 1.
///
/// h is in the wrenches of W_any. Each axis is measured in units of `Problem::desired`.
///
/// @throws std::invalid_argument as `make_ellipsoid`.
std::unique_ptr<Measure> make_ellipsoid_trace(const Problem& problem);

/// Makes the dynamic manipulability: the largest acceleration along c [m/s^2 or rad/s^2].
///
/// The robot is at rest without contact, so M v_dot + tau_d = B u and a = J v_dot, and M has the
/// added mass. The value is the positive root along c of the ellipsoid of all such a with
/// |W_u u| <= 1. The axes of W_any count: a is beta c on them. The efforts of the result are those
/// of this acceleration.
///
/// @param problem  the task, which must outlive the measure
/// @throws std::invalid_argument if an actuator cannot act in both directions, or if the task has a
///         second contact, or the robot a gear or a link that no body can have.
std::unique_ptr<Measure> make_dynamic_manipulability(const Problem& problem);

/// Makes the dynamic capability: the linear or angular acceleration that is possible in every
/// direction [m/s^2 or rad/s^2].
///
/// If c is a force, it is the largest beta such that each linear acceleration a on the axes of
/// W_any with |a| <= beta, without angular acceleration, keeps all efforts within their limits; if
/// c is a torque, the same for angular ones. At rest without contact these efforts are
///
///     u = B^+ (tau_d + J'W Lambda W'a),   Lambda = (W'J M^-1 J'W)^-1.
///
/// The efforts of the result are those of the worst direction. Of the hypersurface of Bowling and
/// Khatib it is the section without velocities and forces.
///
/// @param problem  the task, which must outlive the measure
/// @throws std::invalid_argument if B does not have full row rank, or c has both force and torque,
///         or as `make_dynamic_manipulability` for a task or robot without accelerations.
std::unique_ptr<Measure> make_dynamic_capability(const Problem& problem);

}  // namespace maxwrench
