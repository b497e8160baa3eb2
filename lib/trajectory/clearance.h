#pragma once

#include <optional>
#include <vector>

#include "lib/robot/kinematics.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

class MotionEvaluator;

/// Appends the pairs of bodies closer than `within` [m], at a configuration with the given links,
/// to `pairs`, each with the index of the knot. Only pairs whose distance is known count. Each has
/// its clearance and the gradient of the clearance over theta_r, from the velocities of the closest
/// points along the line between them. `slopes`: those of dependent joints, if there are any
/// (`DependentJoints::slopes`).
void find_near_pairs(const Problem& problem, const Kinematics<double>& kinematics, int knot,
                     double within, std::vector<NearPair>& pairs,
                     const Eigen::MatrixXd& slopes = Eigen::MatrixXd());

/// The same at the knots of a table Q (K×r), and between them if `at_instants`. Knots are numbered
/// from 0. For an impulse the first row is theta_0, which is left out. Stops where the dependent
/// joints have no solution. Leaves the links at the last visited knot or instant.
void find_near_pairs(const Problem& problem, MotionEvaluator& motion, const Eigen::MatrixXd& Q,
                     double within, bool at_instants, Kinematics<double>& kinematics,
                     std::vector<NearPair>& pairs);

/// The first knot of an evaluated motion with a collision, and the pair of bodies; empty if there
/// is none. With `at_instants`, then the first other instant that is not given. Checks what is
/// before the instant at which the motion was lost. Leaves the links at the last checked knot or
/// instant.
std::string first_collision(const Problem& problem, const MotionEvaluator& motion,
                            const std::vector<Instant>& instants, bool at_instants,
                            Kinematics<double>& kinematics);

/// The least clearance at the instants of a table Q; see `TrajectoryEvaluator::least_clearance`.
/// Leaves the links at the last instant.
std::optional<Clearance> find_least_clearance(const Problem& problem, MotionEvaluator& motion,
                                              const Eigen::MatrixXd& Q,
                                              Kinematics<double>& kinematics);

}  // namespace maxwrench
