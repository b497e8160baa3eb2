#pragma once

#include <string>
#include <vector>

#include "maxwrench/tank.h"
#include "solvers/solve/scenario_alone.h"
#include "solvers/solve/tank.h"

namespace maxwrench {

/// The largest number of scenarios that the tank carries out.
inline constexpr int kMostExperiments = 200;

/// The experiment of one scenario of a list: the robot with its limits exerts its wrench.
struct ScenarioExperiment {
  ScenarioTask scenario;
  TrajectoryExperiment experiment;  ///< of a static task without a script

  /// The reading that counts as a factor of the scenario's wrench; NaN if it only holds, or if
  /// there is none.
  double factor() const;
};

/// The experiments of a list of scenarios.
struct ScenarioExperiments : Verdict {
  std::vector<ScenarioExperiment> all;
  double planned = 0;  ///< the planned factor [unit of the task]

  /// The one with the least factor: one without a reading before all others, one that only holds
  /// last.
  const ScenarioExperiment& worst() const;
  bool held() const;  ///< whether each of them was held
};

/// Checks that the tank can carry out the scenarios of a task, if it has a list.
///
/// @throws std::invalid_argument, in one line, if wrenches are a ball or a payload, loads are
///         uncertain or in a current, a joint is locked, in time also `hold`, or if there are more
///         than kMostExperiments.
void require_tank_scenarios(const Problem& problem);

/// One experiment after the other at the posture of a static task with a list. Each exerts `factor`
/// times its wrench; 0: the value of the list. With deaths, all actuators work at first, so only
/// the wrenches differ. The status is that of the last one: an interruption ends them all.
ScenarioExperiments simulate_scenarios(const Answer& answer, double factor,
                                       const std::string& integrator, const TankOptions& options);

/// The same along a trajectory.
ScenarioExperiments simulate_scenarios(const Problem& problem, const Trajectory& trajectory,
                                       Wrench wrench, const TrajectorySolverEntry& lp,
                                       const ScriptOptions& script, const std::string& integrator,
                                       const TankOptions& options);

}  // namespace maxwrench
