#pragma once

#include <string>

#include "lib/path/scheme.h"
#include "maxwrench/plan.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// How far a table may lie beyond limits, speed limits (rad/s, m/s) and rows that must vanish.
inline constexpr double kTableTolerance = 1e-6;

/// Empty, or which knots and joint of the table Q (K×r, theta_0 of a heave first) leave the limits
/// of theta_r, of its rate, or what must vanish.
std::string knots_violation(const Problem& problem, const SchemeMaps& maps,
                            const Eigen::MatrixXd& Q);

/// The limits of the rates, and of theta_r between knots, of a task.
KnotRows knot_rows(const Problem& problem, const MotionTask& task, const SchemeMaps& maps);

}  // namespace maxwrench
