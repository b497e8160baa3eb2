#pragma once

#include <string>
#include <vector>

#include "lib/trajectory/scheme.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

class MotionEvaluator;
struct MotionSlopes;

/// The tolerance of a table's limits, speed limits (rad/s, m/s) and rows that must vanish.
inline constexpr double kTableTolerance = 1e-6;

/// Describes the knots and the joint at which the table Q (K×r, theta_0 of an impulse first)
/// violates the limits of theta_r, those of its rate, or a row that must vanish. Empty if there is
/// no violation.
std::string knots_violation(const Problem& problem, const SchemeMaps& maps,
                            const Eigen::MatrixXd& Q);

/// Describes the first violation of an evaluated motion; empty if there is none. The motion may be
/// lost (`MotionEvaluator::lost`), the base may leave its free axes, or a dependent joint may
/// violate its limits or, at an instant or from knot to knot, its speed limit.
std::string motion_violation(const Problem& problem, const MotionEvaluator& motion,
                             const std::vector<Instant>& instants);

/// Whether the dependent joints are within their limits and their speed limits at one instant of a
/// task in time. q: all joints; v: all velocities.
bool dependent_joints_hold(const Problem& problem, const Eigen::VectorXd& q,
                           const Eigen::VectorXd& v);

/// The limits of dependent joints and of their rates at all instants except the start, as functions
/// of the knots (k r, without theta_0 of an impulse). Gives the values at an evaluated motion, and
/// the derivatives.
DependentRows make_dependent_rows(const Problem& problem, const MotionEvaluator& motion,
                                  const std::vector<Instant>& instants,
                                  const std::vector<MotionSlopes>& slopes);

/// The limits of a task on the rates of theta_r and on theta_r between knots. Each row is of one
/// coordinate. All coordinates have equally many rows, one coordinate after the other.
KnotRows knot_rows(const Problem& problem, const MotionTask& task, const SchemeMaps& maps);

}  // namespace maxwrench
