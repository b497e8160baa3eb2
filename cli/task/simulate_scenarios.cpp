#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/write_file.h"
#include "cli/output.h"
#include "cli/task/simulate.h"
#include "maxwrench/figures.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"
#include "solvers/solve/tank_scenarios.h"

namespace maxwrench {
namespace {

/// The most curves of the figure of a static task.
constexpr std::size_t kMostExperimentCurves = 6;

nlohmann::ordered_json experiment_object(const ScenarioExperiment& each) {
  const TankRun& run = each.experiment.run;
  const TankSummary& s = run.summary;
  const bool ran = !run.samples.empty();
  nlohmann::ordered_json object = {
      {"name", each.scenario.name},
      {"status", to_string(run.status)},
      {"reason", run.reason.str()},
      {"unit", each.scenario.task.unit()},
      {"planned", known(ran, s.planned)},
      {"mean", known(ran && std::isfinite(s.mean), s.mean)},
      {"low", known(ran && std::isfinite(s.low), s.low)},
      {"high", known(ran && std::isfinite(s.high), s.high)},
      {"factor", known(std::isfinite(each.factor()), each.factor())},
      {"configuration_error",
       known(ran && std::isfinite(s.configuration_error), s.configuration_error)},
      {"violation", known(ran, s.violation)},
      {"held", s.held},
      {"missed", s.missed},
      {"end", ran ? run.samples.back().t : 0}};
  if (s.after) object["after"] = after_object(*s.after);
  return object;
}

void print_experiments_object(const Problem& problem, const SimulateOptions& options,
                              const ScenarioExperiments& experiments) {
  auto all = nlohmann::ordered_json::array();
  for (const ScenarioExperiment& each : experiments.all) all.push_back(experiment_object(each));
  const ScenarioExperiment& worst = experiments.worst();
  nlohmann::ordered_json object = {
      {"problem", problem.name},
      {"integrator", options.integrator},
      {"status", to_string(experiments.status)},
      {"reason", experiments.reason.str()},
      {"unit", problem.unit()},
      {"planned", known(std::isfinite(experiments.planned), experiments.planned)},
      {"worst", worst.scenario.name},
      {"reading", known(std::isfinite(worst.factor()), worst.factor())},
      {"held", experiments.held()},
      {"scenarios", all},
      {"version", version()}};
  if (!options.tank.deaths.empty()) object["dies"] = deaths_object(problem.robot, options.tank);
  print_json(object);
}

/// "8.95532, between 8.95424 and 9.00255", in the unit of the scenario.
std::string words_of_experiment(const ScenarioExperiment& each) {
  const TankSummary& s = each.experiment.run.summary;
  if (each.experiment.run.samples.empty() || !std::isfinite(s.mean)) return "none";
  return fmt::format("{:.5f} of {:.5f} {}, between {:.5f} and {:.5f}", reading_of(s), s.planned,
                     each.scenario.task.unit(), s.low, s.high);
}

void print_experiments_text(const Problem& problem, const SimulateOptions& options,
                            const ScenarioExperiments& experiments) {
  fmt::print("{}  virtual tank  integrator {}\n", problem.name, options.integrator);
  if (std::isfinite(experiments.planned)) {
    fmt::print("planned     {:.5f} {}\n", experiments.planned, problem.unit());
  }
  print_deaths(problem.robot, options.tank);
  long held = 0;
  for (const ScenarioExperiment& each : experiments.all) {
    const TankSummary& s = each.experiment.run.summary;
    held += s.held;
    fmt::print("{}  {}: {}{}{}\n", s.held ? "held      " : "not held  ", each.scenario.name,
               words_of_experiment(each), s.missed.empty() ? "" : "; ", s.missed);
    if (s.after) print_after(*s.after);
  }
  const ScenarioExperiment& worst = experiments.worst();
  fmt::print("worst       {} by {}\n",
             std::isfinite(worst.factor()) ? fmt::format("{:.5f}", worst.factor()) : "no reading",
             worst.scenario.name);
  fmt::print("{} in {} of {} scenarios", experiments.held() ? "held" : "not held: held", held,
             experiments.all.size());
  if (experiments.status != Status::kReached) {
    fmt::print(", {}: {}", to_string(experiments.status), experiments.reason.c_str());
  }
  fmt::print("\n");
}

/// The tables of all experiments below each other, behind a column with the scenario's name.
std::string experiments_table(const ScenarioExperiments& experiments) {
  std::string text;
  for (const ScenarioExperiment& each : experiments.all) {
    const std::string table = tank_csv(each.scenario.task, each.experiment.run);
    const std::string name = each.scenario.name.find(',') == std::string::npos
                                 ? each.scenario.name
                                 : '"' + each.scenario.name + '"';
    std::size_t from = 0;
    for (bool header = true; from < table.size(); header = false) {
      const std::size_t to = table.find('\n', from) + 1;
      if (!header) text += name + "," + table.substr(from, to - from);
      if (header && text.empty()) text += "scenario," + table.substr(from, to - from);
      from = to;
    }
  }
  return text;
}

/// The worst ones of a static task, the worst one of a task in time.
std::string experiments_figure(const Problem& problem, const ScenarioExperiments& experiments) {
  const ScenarioExperiment& worst = experiments.worst();
  std::vector<TankCurve> curves = {{worst.scenario.name, &worst.experiment.run}};
  if (problem.motion) return motion_figure(worst.scenario.task, curves);
  for (const ScenarioExperiment& each : experiments.all) {
    if (&each == &worst || curves.size() == kMostExperimentCurves) continue;
    curves.push_back({each.scenario.name, &each.experiment.run});
  }
  return tank_figure(worst.scenario.task, curves);
}

}  // namespace

int report_experiments(const Problem& problem, const SimulateOptions& options,
                       const ScenarioExperiments& experiments) {
  if (!options.out.empty()) write_file(options.out, experiments_table(experiments));
  (options.json ? print_experiments_object : print_experiments_text)(problem, options, experiments);
  // Comes last: it rejects an experiment without samples, but the answer is valid even then.
  if (!options.figure.empty()) write_file(options.figure, experiments_figure(problem, experiments));
  return experiments.status == Status::kReached ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
