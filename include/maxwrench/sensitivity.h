#pragma once

#include <string>
#include <vector>

#include "maxwrench/solve.h"

/// @file
/// What each actuator is worth to a static task.

namespace maxwrench {

/// A task with some actuators lost.
struct LossEffect {
  std::string name;   ///< as `ScenarioLimits::name`; empty: nothing is lost
  Answer at_posture,  ///< the value at the given posture
      best;           ///< the best posture that a search finds for this loss
};

/// The losses of a task, compared.
struct Sensitivity {
  std::vector<LossEffect> effects;  ///< in the order of the limits
  /// One posture for all of them: at the given posture, and the best that a search finds. The value
  /// is the least over all limits.
  LossEffect all;
};

/// Computes what a task is worth with each of several limits of its actuators.
///
/// @param task     a static task with one contact
/// @param theta_r  the given posture (r)
/// @param limits   the limits to compare, such as those of the intact robot and of each loss
/// @param options  measure linf_polytope, wrench, solver, search, budget and others, of each search
/// @return the values; searches after an interruption have none
/// @throws std::invalid_argument as `evaluate`, and for a task in time or with a second contact.
Sensitivity sensitivity(const Problem& task, const Eigen::VectorXd& theta_r,
                        const std::vector<ScenarioLimits>& limits, const Options& options = {});

/// Returns the comparison as a table. Effects stand in the order of their best values.
std::string summary(const Sensitivity& sensitivity);

/// Returns the comparison as a JSON object on one line.
std::string to_json(const Sensitivity& sensitivity);

}  // namespace maxwrench
