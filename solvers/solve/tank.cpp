#include "solvers/solve/tank.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/robot/chain.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

/// Throws unless a hanging mass can exert the wrench.
void require_weight(const Answer& answer) {
  const Problem& problem = *answer.task;
  if (!problem.c.isApprox(Vector6d::Unit(2), 1e-9)) {
    throw std::invalid_argument(
        "--load, --heaviest: got a task whose wrench is not an upward force, as a weight requires, "
        "expected a task such as uvms/lift");
  }
  if (answer.choice.wrench != Wrench::kPure) {
    throw std::invalid_argument("--wrench: got any, expected pure: a load exerts only its weight");
  }
  if (!(problem.robot.gravity > 0)) {
    throw std::invalid_argument("--load: got a robot without gravity, expected gravity > 0");
  }
}

}  // namespace

TargetWrench target_wrench(const Problem& problem, const Capability& capability, double planned,
                           Wrench wrench) {
  // Beyond the capability, only the component along c grows. Below it, all components shrink
  // together, which is feasible because the set of efforts is convex.
  const double share = std::clamp(planned / problem.c.dot(capability.h), 0.0, 1.0);
  TargetWrench target{share * capability.h, share * capability.u, wrench};
  target.h += (planned - problem.c.dot(target.h)) * problem.c;
  return target;
}

TankRun simulate_posture(const Answer& answer, double planned, const std::string& integrator,
                         const TankOptions& options) {
  const TargetWrench target =
      target_wrench(*answer.task, answer.capability, planned, answer.choice.wrench);
  return run_tank(*answer.task, answer.posture, target, *find_integrator(integrator).make(),
                  options);
}

TankRun simulate_load(const Answer& answer, double load, const std::string& integrator,
                      TankOptions options) {
  require_weight(answer);
  options.load = load;
  return simulate_posture(answer, load * answer.task->robot.gravity, integrator, options);
}

HeaviestLoad heaviest_load(const Answer& answer, const std::string& integrator,
                           TankOptions options) {
  require_weight(answer);
  options.until_hold = true;
  HeaviestLoad heaviest;
  heaviest.conclude(Status::kBestFound);
  int& held = heaviest.mass;
  int lost = std::max(1, static_cast<int>(answer.beta_linf / answer.task->robot.gravity) + 2);
  while (lost - held > 1) {
    const int mass = (held + lost) / 2;
    const TankRun run = simulate_load(answer, mass, integrator, options);
    if (run.status == Status::kBudgetExhausted && options.interrupted && options.interrupted()) {
      heaviest.conclude(run.status, run.reason.c_str());  // says nothing about this mass
      break;
    }
    (run.summary.held ? held : lost) = mass;
  }
  return heaviest;
}

TrajectoryExperiment simulate_trajectory(const Problem& problem, const Trajectory& trajectory,
                                         Wrench wrench, const TrajectorySolverEntry& lp,
                                         const ScriptOptions& script, const std::string& integrator,
                                         const TankOptions& options) {
  TrajectoryExperiment experiment;
  ScriptOptions asked = script;
  if (options.invert_lag) {
    asked.thruster_lag = std::max(asked.thruster_lag, options.thruster_lag);
  }
  experiment.script = make_script(problem, trajectory, wrench, *lp.make(), asked);
  experiment.run.conclude(experiment.script.status, experiment.script.reason.c_str());
  if (experiment.script.status == Status::kOptimal) {
    experiment.run =
        run_tank(problem, experiment.script, *find_integrator(integrator).make(), options);
  }
  return experiment;
}

ActuatorDeath death_of(const Robot& robot, const std::string& key, const std::string& name,
                       double t) {
  std::vector<std::string> known;
  for (int i = 0; i < robot.actuators(); ++i) {
    known.push_back(actuator_name(robot, i));
    if (known.back() == name) return {i, t};
  }
  throw std::invalid_argument(
      fmt::format("{}: got '{}', expected one of {}", key, name, fmt::join(known, ", ")));
}

Interpolation usual_interpolation(const Problem& problem) {
  return problem.motion->scheme == Scheme::kSpline ? Interpolation::kSpline
                                                   : Interpolation::kLinear;
}

std::string tank_csv(const Problem& problem, const TankRun& run) {
  std::string text = "t,planned,reading,f_x,f_y,f_z,n_x,n_y,n_z";
  for (const Thruster& thruster : problem.robot.thrusters) text += "," + thruster.name;
  for (const Joint& joint : problem.robot.joints) text += "," + joint.name;
  text += ",saturated,relaxed,shortfall,theta_r_error,position_error";
  for (int i = 0; run.summary.motion && i < problem.redundancy(); ++i) {
    text += ",theta_r_" + problem.theta_r_name(i);
  }
  text += run.summary.motion ? ",angle\n" : "\n";
  for (const TankSample& sample : run.samples) {
    text += fmt::format("{:.6g},{:.6g},{:.6g}", sample.t, sample.planned, sample.reading);
    for (const double value : sample.h_e) text += fmt::format(",{:.6g}", value);
    for (const double value : sample.u) text += fmt::format(",{:.6g}", value);
    text += fmt::format(",{},{},{:.3g},{:.3g},{:.3g}", int{sample.saturated}, int{sample.relaxed},
                        sample.shortfall, sample.theta_r_error, sample.position_error);
    for (const double value : sample.theta_r) text += fmt::format(",{:.6g}", value);
    text += run.summary.motion ? fmt::format(",{:.6g}\n", sample.angle) : "\n";
  }
  return text;
}

}  // namespace maxwrench
