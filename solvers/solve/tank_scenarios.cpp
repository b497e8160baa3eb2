#include "solvers/solve/tank_scenarios.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

[[noreturn]] void throw_untankable(const Problem& problem, const std::string& got,
                                   const std::string& expected) {
  throw std::invalid_argument(problem.name + ": got " + got + ", expected " + expected +
                              " for the virtual tank");
}

/// The scenarios that the tank carries out. Where actuators die, all of them work at first.
std::vector<int> tank_choices(const Problem& problem, const TankOptions& options) {
  std::vector<int> chosen;
  const int limits = static_cast<int>(problem.scenarios.limits.size());
  for (int i = 0; i < scenario_count(problem); ++i) {
    if (options.deaths.empty() || i % limits == 0) chosen.push_back(i);
  }
  return chosen;
}

/// The largest wrench of the list for a factor of 1.
double longest_wrench(const ScenarioList& list) {
  double most = 0;
  for (const ScenarioWrench& each : list.wrenches) most = std::max(most, each.c.norm());
  return most;
}

/// The capability of a scenario alone, at the posture of the list.
Capability alone_at(const Posture& posture, const ScenarioTask& one, Wrench wrench) {
  WrenchProgram program = make_wrench_program(one.task, wrench);
  set_posture(posture, program);
  Capability capability;
  find_wrench_solver("simplex").make()->solve(program, true, capability);
  if (capability.status == Status::kOptimal) capability.h = program.W * capability.w;
  return capability;
}

/// The experiment at the posture of the list, in whose scenarios the wrenches grow together.
TankRun hold_scenario(const Answer& list, const ScenarioTask& one, double factor,
                      const std::string& integrator, const TankOptions& options) {
  const Wrench wrench = list.choice.wrench;
  TargetWrench target{Vector6d::Zero(), Eigen::VectorXd::Zero(one.task.robot.actuators()), wrench,
                      factor * longest_wrench(list.task->scenarios)};
  if (one.length > 0) {
    const Capability most = alone_at(list.posture, one, wrench);
    if (most.status != Status::kOptimal) {
      TankRun none;
      none.conclude(most.status, most.reason.c_str());
      none.summary.missed = most.reason.str();
      return none;
    }
    target = target_wrench(one.task, most, factor * one.length, wrench);
  }
  return run_tank(one.task, list.posture, target, *find_integrator(integrator).make(), options);
}

bool tank_interrupted(const TankRun& run, const TankOptions& options) {
  return run.status == Status::kBudgetExhausted && options.interrupted && options.interrupted();
}

/// Runs `carry_out` for one scenario after the other.
template <class CarryOut>
ScenarioExperiments each_scenario(const Problem& problem, double planned,
                                  const TankOptions& options, const CarryOut& carry_out) {
  ScenarioExperiments experiments;
  experiments.planned = planned;
  experiments.conclude(Status::kReached);
  for (const int i : tank_choices(problem, options)) {
    ScenarioExperiment each{scenario_alone(problem, i), {}};
    each.experiment = carry_out(each.scenario);
    const TankRun& run = each.experiment.run;
    if (run.status != Status::kReached) experiments.conclude(run.status, run.reason.c_str());
    const bool stop = tank_interrupted(run, options);
    experiments.all.push_back(std::move(each));
    if (stop) break;
  }
  return experiments;
}

}  // namespace

double ScenarioExperiment::factor() const {
  return scenario.length > 0 && !experiment.run.samples.empty()
             ? reading_of(experiment.run.summary) / scenario.length
             : std::nan("");
}

const ScenarioExperiment& ScenarioExperiments::worst() const {
  const auto rank = [](const ScenarioExperiment& each) {
    if (each.scenario.length == 0) return std::pair(each.experiment.run.summary.held ? 2 : 0, 0.0);
    const double factor = each.factor();
    return std::isnan(factor) ? std::pair(0, 0.0) : std::pair(1, factor);
  };
  return *std::min_element(all.begin(), all.end(),
                           [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

bool ScenarioExperiments::held() const {
  return std::all_of(all.begin(), all.end(), [](const ScenarioExperiment& each) {
    return each.experiment.run.summary.held;
  });
}

void require_tank_scenarios(const Problem& problem) {
  const ScenarioList& list = problem.scenarios;
  if (list.empty()) return;
  if (list.ball) throw_untankable(problem, "a ball of wrenches", "wrenches one by one");
  if (list.payload) throw_untankable(problem, "a payload", "a wrench");
  if (!list.loads.empty()) {
    throw_untankable(problem, "loads that are uncertain or in a current", "the nominal robot");
  }
  for (const ScenarioLimits& limits : list.limits) {
    if (limits.resists) {
      throw_untankable(problem, "a joint that is locked or has friction",
                       "limp joints without friction");
    }
  }
  for (const ScenarioWrench& each : list.wrenches) {
    if (each.hold && problem.motion) {
      throw_untankable(problem, "wrench.hold", "a wrench in each scenario of a task in time");
    }
  }
  if (list.count() > kMostExperiments) {
    throw_untankable(problem, std::to_string(list.count()) + " scenarios",
                     "at most " + std::to_string(kMostExperiments));
  }
}

ScenarioExperiments simulate_scenarios(const Answer& answer, double factor,
                                       const std::string& integrator, const TankOptions& options) {
  const Problem& problem = *answer.task;
  require_tank_scenarios(problem);
  const double planned = factor > 0 ? factor : answer.capability.beta;
  return each_scenario(problem, planned, options, [&](const ScenarioTask& one) {
    return TrajectoryExperiment{{}, hold_scenario(answer, one, planned, integrator, options)};
  });
}

ScenarioExperiments simulate_scenarios(const Problem& problem, const Trajectory& trajectory,
                                       Wrench wrench, const TrajectorySolverEntry& lp,
                                       const ScriptOptions& script, const std::string& integrator,
                                       const TankOptions& options) {
  require_tank_scenarios(problem);
  const double planned = planned_wrench(trajectory, script);
  return each_scenario(problem, planned, options, [&](const ScenarioTask& one) {
    ScriptOptions own = script;
    own.planned = std::isfinite(planned) ? planned * one.length : script.planned;
    return simulate_trajectory(one.task, trajectory, wrench, lp, own, integrator, options);
  });
}

}  // namespace maxwrench
