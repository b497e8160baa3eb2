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

}  // namespace maxwrench
