#pragma once

#include <string>
#include <vector>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/problem.h"
#include "tests/support/support.h"
#include "verify/interval.h"
#include "verify/trajectory/trajectory_certificate.h"

// Certificates of trajectories, for tests.

namespace maxwrench {

/// A shipped table of knots, such as "uvms_valve_trajectory_spline".
Eigen::MatrixXd shipped_knots(const std::string& name, const Problem& problem);

/// The certificate of a trajectory, which must be provable. Limits of the task may differ from
/// those of its files.
TrajectoryCertificate certified(const Problem& problem, const Eigen::MatrixXd& knots,
                                int parts = 0);

/// Knots of uvms/valve_trajectory_fast, where effort rates bind so much that no wrench of one size
/// can be exerted throughout as large as the least of one that varies.
Eigen::MatrixXd fast_turn_knots();

/// The knots of the default posture plus a random motion within the limits.
Eigen::MatrixXd moving_knots(const Problem& problem, Random& random);

/// The motion by `lib`, with so many parts in each interval that instant i * parts + j is at j /
/// parts of interval i.
std::vector<Instant> instants_by_lib(const Problem& problem, const Eigen::MatrixXd& knots,
                                     int parts);

/// Checks that an interval holds a number that was computed with some rounding.
void expect_holds(const Narrow& interval, double x, double rounding, const char* what);

}  // namespace maxwrench
