#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "solvers/solve/tank.h"

namespace maxwrench {
namespace {

void conclude_experiment(const TankRun& run, Answer& answer) {
  static_cast<Verdict&>(answer) = run;
  answer.evaluations = run.evaluations;
  if (run.status != Status::kReached) return;
  answer.missed = run.summary.missed;
  const double reading = reading_of(run.summary);
  if (std::isfinite(reading) && !run.summary.lost) {
    answer.trajectory.value = reading;
  } else {
    answer.conclude(Status::kNoneFound, "the posture was lost before the end");
  }
}

void carry_out_posture(const Case& c, Answer& answer) {
  const Problem& task = *answer.task;
  // The controller holds the end effector at its pose for theta_r.
  const Problem held = held_at(task, task.theta_r_default);
  const Answer posture = evaluate(held, held_theta_r(task, task.theta_r_default), {c});
  answer.trajectory.knots = task.theta_r_default.transpose();
  static_cast<Verdict&>(answer) = posture;
  if (!posture.has_value()) return;
  answer.beta_linf = held.c.dot(posture.capability.h);
  if (answer.beta_linf > 0) {
    conclude_experiment(simulate_posture(posture, answer.beta_linf, c.integrator, TankOptions()),
                        answer);
  } else {
    answer.conclude(Status::kNoneFound, "the default posture exerts nothing along c");
  }
}

void carry_out_trajectory(const Method& method, Answer& answer) {
  const Problem& task = *answer.task;
  answer.trajectory.knots = default_knots(task);
  TrajectoryEvaluator evaluator(task, method.choice.wrench, method.trajectory_solver->make);
  static_cast<Verdict&>(answer) = evaluator.evaluate(answer.trajectory.knots);
  if (evaluator.trajectory().status != Status::kOptimal) return;
  evaluator.evaluate_between_knots();
  ScriptOptions script;
  script.interpolation = usual_interpolation(task);
  script.margin = TankOptions().margin;
  const TrajectoryExperiment experiment = simulate_trajectory(
      task, evaluator.trajectory(), method.choice.wrench, *method.trajectory_solver, script,
      method.choice.integrator, TankOptions());
  answer.beta_linf = experiment.script.planned;
  conclude_experiment(experiment.run, answer);
}

}  // namespace

double reading_of(const TankSummary& summary) {
  if (!summary.motion) return summary.mean;
  return std::isfinite(summary.motion->at_peak) ? summary.motion->at_peak : summary.low;
}

std::vector<std::string> supported_integrators(const Problem& problem, const std::string& measure) {
  const bool factor = problem.motion && problem.motion->has_factor();
  const bool one_wrench = !problem.contact && !factor && problem.scenarios.empty();
  const bool supports = one_wrench && measure == Case().measure && !unmodelled(problem.robot);
  return supports ? stiff_integrators() : std::vector<std::string>();
}

Answer experiment(const Problem& task, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  check(task.robot);
  const std::vector<std::string> supported = supported_integrators(task, options.measure);
  if (std::find(supported.begin(), supported.end(), options.integrator) == supported.end()) {
    throw std::invalid_argument(
        fmt::format("integrator: got '{}', expected one that supports measure {} of {}: {}",
                    options.integrator, options.measure, task.name, fmt::join(supported, " ")));
  }
  Answer answer;
  answer.task = std::make_shared<const Problem>(task);
  const Method method = resolve(*answer.task, options);
  answer.choice = method.choice;
  answer.unit = task.unit();
  if (task.motion) {
    carry_out_trajectory(method, answer);
  } else {
    carry_out_posture(method.choice, answer);
  }
  answer.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

}  // namespace maxwrench
