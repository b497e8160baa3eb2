#pragma once

#include <limits>
#include <string>
#include <vector>

#include "maxwrench/explain.h"
#include "maxwrench/status.h"
#include "maxwrench/trajectory.h"

/// @file
/// Disturbance margins: what an end effector can exert beside what its motion needs.

namespace maxwrench {

/// A set of wrenches at the end effector.
struct MarginSet {
  /// Axes [force; torque] (6×d), all of forces or all of torques, orthonormal. The set is the ball
  /// {E z : |z| <= 1}, in any direction of these axes. The default is any force.
  Matrix6Xd E = Matrix6Xd::Identity(6, 3);
  bool in_end_effector = false;  ///< whether E is in axes of the end effector, not of the world
  /// Whether the set is that of the task, c of each instant or its list of wrenches, in place of E.
  bool of_task = false;
};

/// Returns the ball of some axes, such as {"fx", "fy"}.
///
/// @throws std::invalid_argument for other names than `kWrenchAxes`, one that occurs twice, none,
///         or forces and torques together.
MarginSet margin_ball(const std::vector<std::string>& axes, bool in_end_effector = false);

/// The margin at one instant of a motion.
struct InstantMargin : Verdict {
  double t = 0;  ///< time [s]
  /// The margin [N, N m, or the unit of the task's set]; negative or -infinity: the motion itself
  /// needs more than the actuators can exert. See `motion_margin`.
  double margin = std::numeric_limits<double>::quiet_NaN();
  /// The wrench of the set, at a margin of one, that meets the limits first; in world axes. Zero if
  /// the margin is infinite.
  Vector6d worst = Vector6d::Zero();
  int facet = -1;      ///< the pair of facets of {B u} that binds; -1: none does
  std::string limits;  ///< of a task with losses: what is lost where it binds
  /// The limits of actuators that bind, largest rate first. `rate` is d margin/d limit. Of a margin
  /// of -infinity the rates are those of the facet's normal.
  std::vector<LimitRate> binding;
  /// The efforts that exert `margin` times `worst` (m) [N or N m]; empty if the motion is
  /// infeasible.
  Eigen::VectorXd u;
  /// The largest factor of `worst` by a linear program; NaN if the motion is infeasible.
  double by_program = std::numeric_limits<double>::quiet_NaN();
};

/// The margins of a motion.
///
/// The status is
///
/// * kOptimal, if the actuators can exert the motion at all instants and each margin is verified;
/// * kInfeasible, if the motion itself needs more than they can at some instant;
/// * kUnbounded, if no wrench of the set loads any actuator;
/// * kNumericalError, if a margin could not be verified.
struct MotionMargin : Verdict {
  std::string problem;                  ///< name of the task
  std::string set;                      ///< the set in words, such as "any of fx fy fz, world axes"
  std::string unit;                     ///< unit of the margins
  std::vector<InstantMargin> instants;  ///< the margins
  int worst = -1;                       ///< the instant with the least margin, the first of several
  int infeasible = 0;                   ///< number of instants at which the motion is infeasible
  Residual residual;                    ///< the largest one of all linear programs
  double difference = 0;                ///< the largest |margin - value of its check| [unit]
  double wall_s = 0,                    ///< time of all margins, without verification [s]
      checks_s = 0;                     ///< time of their verification [s]
};

/// Computes how much an end effector can exert beside what the motion itself needs.
///
/// At an instant with tau_d of the inverse dynamics and a set T of wrenches, the margin is the
/// largest factor r such that
///
///     for every h in T there are efforts with  B u = tau_d + r J'h,   u_min <= u <= u_max.
///
/// For a ball of forces it is the radius of the largest ball about zero in the residual force
/// polytope {E z : tau_d + J'E z in {B u}} (Ferrolho et al., Residual force polytope, 2021). With
/// the facets b_min,j <= n_j'tau <= b_max,j of {B u} it is
///
///     r = min over j of (b_max,j - n_j'tau_d) / |E'J n_j| and (n_j'tau_d - b_min,j) / |E'J n_j|.
///
/// Efforts may answer to the disturbance, and their rates are not limited. h is what the robot
/// exerts; a disturbance is -h.
///
/// If the motion itself is infeasible, the margin is negative: the motion remains infeasible with
/// the help of any |factor| < |r| of the set. It is -infinity if no wrench of the set helps.
///
/// Each margin is checked by a linear program from B, the limits, J and tau_d: the largest factor
/// of the worst wrench, with efforts that exert it. If the motion is infeasible, the program with a
/// wrench of zero has to be infeasible as well, and the limits of the efforts give the margin
/// again.
///
/// @param task      a task with one contact; its losses and weaker actuators count, at each instant
///                  the worst of them
/// @param instants  the motion: those of `motion_instants` or of an evaluated `Trajectory`
/// @param set       the set of wrenches
/// @throws std::invalid_argument with one line if there are no instants, one has values that are
/// not
///         finite or of the wrong size, the actuators have no facets, the task has a second contact
///         or uncertain loads, which are loads at rest, or the set is wrong.
MotionMargin motion_margin(const Problem& task, const std::vector<Instant>& instants,
                           const MarginSet& set = {});

/// Returns the margin in words, with its verification.
std::string summary(const MotionMargin& margin);
/// Returns the margin as a JSON object on one line. A margin of -infinity is null.
std::string to_json(const MotionMargin& margin);
/// Returns the margins as CSV, a row for each instant: t, margin, status, the worst wrench for a
/// margin of one, facet, the limits that bind as NAME:min or NAME:max, and what is lost.
std::string margin_csv(const MotionMargin& margin);

}  // namespace maxwrench
