#include "solvers/solve/tank_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/solve/plan_row.h"
#include "solvers/solve/row.h"
#include "solvers/solve/tank_experiment.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

double reading_of(const TankSummary& summary) {
  if (!summary.motion) return summary.mean;
  return std::isfinite(summary.motion->at_peak) ? summary.motion->at_peak : summary.low;
}

void conclude_experiment(const TankRun& run, TankRow& row) {
  static_cast<Verdict&>(row) = run;
  row.evaluations = run.evaluations;
  if (run.status != Status::kReached) return;
  row.missed = run.summary.missed;
  const double reading = reading_of(run.summary);
  if (std::isfinite(reading) && !run.summary.lost) {
    row.reading = reading;
  } else {
    row.conclude(Status::kNoneFound, "the posture was lost before the end");
  }
}

void carry_out_posture(const Problem& task, TankRow& row) {
  // The controller holds the end effector where theta_r has it.
  const Problem problem = held_at(task, task.theta_r_default);
  const Row posture =
      evaluate(problem, resolve(problem, row.choice), held_theta_r(task, task.theta_r_default));
  row.theta_r = task.theta_r_default;
  static_cast<Verdict&>(row) = posture;
  if (!posture.has_value()) return;
  row.planned = problem.c.dot(posture.capability.h);
  if (row.planned > 0) {
    conclude_experiment(
        simulate_tank(problem, posture, row.planned, row.choice.integrator, TankOptions()), row);
  } else {
    row.conclude(Status::kNoneFound, "the default posture exerts nothing along c");
  }
}

void carry_out_plan(const Problem& problem, TankRow& row) {
  const PlanMethod method = resolve_plan(problem, row.choice);
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  row.theta_r = stacked(knots);
  PlanEvaluator evaluator(problem, row.choice.wrench, method.solver->make);
  static_cast<Verdict&>(row) = evaluator.evaluate(knots);
  if (evaluator.plan().status != Status::kOptimal) return;
  evaluator.evaluate_continuous();
  ScriptOptions script;
  script.interpolation = usual_interpolation(problem);
  script.margin = TankOptions().margin;
  const PlanExperiment experiment =
      simulate_plan(problem, evaluator.plan(), row.choice.wrench, *method.solver, script,
                    row.choice.integrator, TankOptions());
  row.planned = experiment.script.planned;
  conclude_experiment(experiment.run, row);
}

}  // namespace

std::vector<std::string> served_integrators(const Problem& problem, const std::string& measure) {
  const bool serves = !problem.contact && measure == Case().measure;
  return serves ? stiff_integrators() : std::vector<std::string>();
}

TankRow run_experiment(const Problem& problem, const Case& c) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::string> served = served_integrators(problem, c.measure);
  if (std::find(served.begin(), served.end(), c.integrator) == served.end()) {
    throw std::invalid_argument(
        fmt::format("integrator: got '{}', expected one that serves measure {} of {}: {}",
                    c.integrator, c.measure, problem.name, fmt::join(served, " ")));
  }
  TankRow row;
  row.choice = complete(problem, c);
  row.unit = problem.unit();
  (problem.motion ? carry_out_plan : carry_out_posture)(problem, row);
  row.wall_s = seconds_since(start);
  return row;
}

std::vector<std::string> values(const Problem& problem, const TankRow& row) {
  const auto known = [](double value) { return std::isfinite(value) ? exact_text(value) : ""; };
  std::vector<std::string> cells = case_values(row.choice);
  cells.insert(cells.end(),
               {to_string(row.status), row.has_value() ? exact_text(row.reading) : "", "", row.unit,
                known(row.planned), problem.unit(), problem.label, exact_text(row.theta_r), "", "",
                "", "", "", "", "", fmt::format("{}", row.evaluations),
                row.has_value() ? row.missed : row.reason.str(), ""});
  return cells;
}

}  // namespace maxwrench
