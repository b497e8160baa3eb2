#pragma once

#include <string>

#include "maxwrench/problem.h"
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

}  // namespace maxwrench
