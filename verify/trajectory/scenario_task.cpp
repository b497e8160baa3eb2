#include "verify/trajectory/scenario_task.h"

#include <cmath>
#include <limits>

namespace maxwrench {

ScenarioTask scenario_task(const Problem& problem, int wrench, int limits) {
  const ScenarioList& list = problem.scenarios;
  const ScenarioWrench& stated = list.wrenches[static_cast<std::size_t>(wrench)];
  const ScenarioLimits& allowed = list.limits[static_cast<std::size_t>(limits)];
  ScenarioTask one{list.wrenches.size() > 1 ? stated.name : "", problem,
                   stated.hold ? 0 : stated.c.norm()};
  if (!allowed.name.empty()) one.name += (one.name.empty() ? "" : "; ") + allowed.name;
  if (one.name.empty()) one.name = "nominal";
  Problem& task = one.task;
  task.scenarios = {};
  task.digest.clear();
  if (!stated.hold) task.c = stated.c / one.length;
  task.W_any.resize(6, 1 + list.F.cols());
  task.W_any << task.c, list.F;
  Zonotope& actuation = task.robot.actuation;
  actuation.u_min = allowed.actuation.u_min;
  actuation.u_max = allowed.actuation.u_max;
  for (Eigen::Index i = 0; i < actuation.u_min.size(); ++i) {
    if (actuation.u_min[i] == 0 && actuation.u_max[i] == 0) actuation.B.col(i).setZero();
  }
  return one;
}

double least_factor(double value, double length) {
  // The length of a vector and the quotient are exact to a few units in the last place.
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const double factor = value / length;
  return factor - kRounding * std::abs(factor);
}

int scenario_count(const Problem& problem) {
  return static_cast<int>(problem.scenarios.wrenches.size() * problem.scenarios.limits.size());
}

ScenarioTask scenario_task(const Problem& problem, int i) {
  const int limits = static_cast<int>(problem.scenarios.limits.size());
  return scenario_task(problem, i / limits, i % limits);
}

}  // namespace maxwrench
