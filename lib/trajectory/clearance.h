#pragma once

#include <optional>
#include <vector>

#include "lib/robot/kinematics.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

class MotionEvaluator;

/// The pairs of bodies nearer than `within` [m] at a configuration whose links are given, of those
/// whose distance is known: clearance and its gradient over theta_r, by the velocities of the
/// nearest points along the line between them. Appended with the number of the knot. `slopes`: of
/// dependent joints, if there are any (`DependentJoints::slopes`).
void find_near_pairs(const Problem& problem, const Kinematics<double>& kinematics, int knot,
                     double within, std::vector<NearPair>& pairs,
                     const Eigen::MatrixXd& slopes = Eigen::MatrixXd());

/// The same at the knots of a table Q (K×r, theta_0 of an impulse first, which is left out), from
/// 0, as far as dependent joints get. Leaves the links there.
void find_near_pairs(const Problem& problem, MotionEvaluator& motion, const Eigen::MatrixXd& Q,
                     double within, Kinematics<double>& kinematics, std::vector<NearPair>& pairs);

/// Empty, or the first knot of an evaluated motion that collides, and which bodies; as far as
/// dependent joints got. Leaves the links there.
std::string knot_collision(const Problem& problem, const MotionEvaluator& motion,
                           const std::vector<Instant>& instants, Kinematics<double>& kinematics);

/// The least clearance at the instants of a table Q, see `TrajectoryEvaluator::least_clearance`.
/// Leaves the links at the last instant.
std::optional<Clearance> find_least_clearance(const Problem& problem, MotionEvaluator& motion,
                                              const Eigen::MatrixXd& Q,
                                              Kinematics<double>& kinematics);

}  // namespace maxwrench
