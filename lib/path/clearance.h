#pragma once

#include <optional>
#include <vector>

#include "lib/robot/kinematics.h"
#include "maxwrench/plan.h"

namespace maxwrench {

/// The pairs of bodies nearer than `within` [m] at a configuration whose links are given, of those
/// whose distance is known: clearance and its gradient over theta_r, by the velocities of the
/// nearest points along the line between them. Appended with the number of the knot.
void find_near_pairs(const Problem& problem, const Kinematics<double>& kinematics, int knot,
                     double within, std::vector<NearPair>& pairs);

/// The least clearance of the robot with theta_r N×r at N times t [s], see
/// `PlanEvaluator::least_clearance`. Leaves the links at the last instant.
std::optional<Clearance> find_least_clearance(const Problem& problem, const std::vector<double>& t,
                                              const Eigen::MatrixXd& theta_r,
                                              Kinematics<double>& kinematics);

}  // namespace maxwrench
