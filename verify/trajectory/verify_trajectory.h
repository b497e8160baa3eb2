#pragma once

#include <string>
#include <vector>

#include "maxwrench/verification.h"
#include "verify/trajectory/effort_law.h"

namespace maxwrench {

/// [rad or m, per s] The limits of theta_r and of its rates may be exceeded by this, as tables that
/// are written with six digits do.
inline constexpr double kKnotTolerance = 1e-6;

/// Checks that theta_r, the dependent joints and their rates are within their limits at all times,
/// and that an impulse begins at rest and without acceleration.
MotionFault check_motion(const TrajectoryModel& model);

/// `check_motion`, and that no bodies collide. Sets the clearance of `result`.
MotionFault check_motion_and_clearance(const TrajectoryModel& model,
                                       TrajectoryVerification& result);

/// Checks what a certificate claims about a motion with its knots and dependent joints. With
/// `check_motion_and_clearance` this is all that `verify` checks. Counts the slices of `result`.
///
/// @throws std::invalid_argument as `narrow_pseudoinverse`.
MotionFault check_efforts(const TrajectoryModel& model, const TrajectoryCertificate& proof,
                          int threads, TrajectoryVerification& result);

/// Checks that a certificate proves its claim about a task: the robot can exert the wrench or
/// more at every instant, with efforts, their commands, effort rates, joints and joint speeds
/// within their limits, and, if the certificate says so, without collision. The efforts are
/// enclosed anew in interval arithmetic, from the problem's data and the certificate, without any
/// code that found them. The result is the same at any number of threads.
///
/// @throws std::invalid_argument as `require_provable`.
TrajectoryVerification verify(const Problem& problem, const TrajectoryCertificate& proof,
                              int threads);

/// The check of certificates of a task, which may have a list of scenarios.
struct TaskVerification : TrajectoryVerification {
  /// What all certificates claim [unit of the task]; NaN if their number is not that of the task.
  double guaranteed = 0;
  std::string decides;  ///< the scenario with the least claim; "" if there is no list
};

/// Checks certificates of one trajectory: one of each scenario of the list, in the order of
/// `scenario_task`, or one of a task without a list. The scenarios are derived anew from the list.
///
/// @throws std::invalid_argument as `require_provable_task`.
TaskVerification verify(const Problem& problem, const std::vector<TrajectoryCertificate>& proofs,
                        int threads);

}  // namespace maxwrench
