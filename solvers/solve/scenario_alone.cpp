#include "solvers/solve/scenario_alone.h"

#include "maxwrench/zonotope.h"

namespace maxwrench {

ScenarioTask scenario_alone(const Problem& problem, int i) {
  ScenarioTask one = scenario_task(problem, i);
  const Zonotope& all = problem.robot.actuation;
  Zonotope& own = one.task.robot.actuation;
  own = own.B == all.B ? with_limits(all, own.u_min, own.u_max)
                       : make_zonotope(own.B, own.u_min, own.u_max);
  return one;
}

}  // namespace maxwrench
