#pragma once

#include <string>

#include "maxwrench/problem.h"

namespace maxwrench {

/// One scenario of a list of wrenches and limits, as a task of its own.
struct ScenarioTask {
  std::string name;  ///< what tells it from the others, as `describe` says it
  /// The task without a list. c is the wrench of length 1, or that of the task if the scenario only
  /// holds. B has no column of an actuator whose limits are both zero: what is lost exerts nothing,
  /// and nothing is shared out to it. Facets, rank and pseudo-inverse are still those of the
  /// robot.
  Problem task;
  double length = 0;  ///< of the wrench for a factor of 1; zero: it only holds
};

/// Number `limits` and number `wrench` of the lists, as a task. Loads must not be uncertain, and
/// there must be no ball and no payload.
ScenarioTask scenario_task(const Problem& problem, int wrench, int limits);

/// The largest factor of a wrench of this length that a wrench of `value` along it contains,
/// rounded down.
double least_factor(double value, double length);

/// The number of scenarios, which are in the order of the wrenches, then of the limits.
int scenario_count(const Problem& problem);

/// Scenario `i` in this order.
ScenarioTask scenario_task(const Problem& problem, int i);

}  // namespace maxwrench
