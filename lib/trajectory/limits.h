#pragma once

#include <string>
#include <vector>

#include "lib/trajectory/scheme.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

class MotionEvaluator;
struct MotionSlopes;

/// How far a table may lie beyond limits, speed limits (rad/s, m/s) and rows that must vanish.
inline constexpr double kTableTolerance = 1e-6;

/// Empty, or which knots and joint of the table Q (K×r, theta_0 of an impulse first) leave the
/// limits of theta_r, of its rate, or what must vanish.
std::string knots_violation(const Problem& problem, const SchemeMaps& maps,
                            const Eigen::MatrixXd& Q);

/// Empty, or where an evaluated motion gets lost (`MotionEvaluator::lost`), the base leaves its
/// free axes, or a dependent joint leaves its limits or, at an instant or from knot to knot, that
/// of its rate.
std::string motion_violation(const Problem& problem, const MotionEvaluator& motion,
                             const std::vector<Instant>& instants);

/// The limits of dependent joints and of their rates at all instants but the start, as functions of
/// the knots (k r, without theta_0 of an impulse): values at an evaluated motion, and derivatives.
DependentRows make_dependent_rows(const Problem& problem, const MotionEvaluator& motion,
                                  const std::vector<Instant>& instants,
                                  const std::vector<MotionSlopes>& slopes);

/// The limits of the rates, and of theta_r between knots, of a task.
KnotRows knot_rows(const Problem& problem, const MotionTask& task, const SchemeMaps& maps);

}  // namespace maxwrench
