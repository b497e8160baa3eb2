#include "cli/task/simulate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "benchmarks/tables/write_file.h"
#include "cli/ctrl_c.h"
#include "cli/task/load_and_solve.h"
#include "maxwrench/figures.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/version.h"
#include "solvers/solve/tank.h"
#include "solvers/solve/tank_scenarios.h"

namespace maxwrench {
namespace {

void print_object(const Problem& problem, const SimulateOptions& options, const TankRun& run) {
  const TankSummary& s = run.summary;
  nlohmann::ordered_json object = {
      {"problem", problem.name},
      {"integrator", options.integrator},
      {"status", to_string(run.status)},
      {"reason", run.reason.str()},
      {"unit", problem.unit()},
      {"load", options.tank.load},
      {"planned", s.planned},
      {"mean", s.mean},
      {"low", s.low},
      {"high", s.high},
      {"across", std::vector<double>(s.across.begin(), s.across.end())},
      {"theta_r_error", s.theta_r_error},
      {"configuration_error", s.configuration_error},
      {"position_error", s.position_error},
      {"deflection_error", s.deflection_error},
      {"saturated", s.saturated},
      {"relaxed", s.relaxed},
      {"shortfall", s.shortfall},
      {"violation", s.violation},
      {"held", s.held},
      {"missed", s.missed},
      {"end", run.samples.empty() ? 0 : run.samples.back().t},
      {"wall_s", run.total_s},
      {"version", version()}};
  if (!options.tank.deaths.empty()) object["dies"] = deaths_object(problem.robot, options.tank);
  if (s.after) object["after"] = after_object(*s.after);
  print_json(object);
}

void print_reading(const SimulateOptions& options, const TankSummary& s) {
  if (options.tank.load > 0) fmt::print("load        {:g} kg\n", options.tank.load);
  if (!std::isfinite(s.mean)) {
    fmt::print("reading     none, the {} before the hold\n",
               std::isfinite(s.theta_r_error) ? "posture was lost" : "experiment ended");
    return;
  }
  fmt::print("{}     {:.5f}, between {:.5f} and {:.5f}\n",
             options.tank.load > 0 ? "carried" : "reading", s.mean, s.low, s.high);
  // Rounded to thousandths; adding zero avoids -0.
  const Vector6d across = (1000 * s.across).array().round() / 1000 + 0.0;
  fmt::print("across      {:.3f} N, {:.3f} N m\n", fmt::join(across.head<3>(), " "),
             fmt::join(across.tail<3>(), " "));
}

void print_text(const Problem& problem, const SimulateOptions& options, const TankRun& run) {
  const TankSummary& s = run.summary;
  fmt::print("{}  virtual tank  integrator {}\n", problem.name, options.integrator);
  fmt::print("planned     {:.5f} {}\n", s.planned, problem.unit());
  print_deaths(problem.robot, options.tank);
  print_reading(options, s);
  if (s.after) print_after(*s.after);
  if (std::isfinite(s.theta_r_error)) {
    fmt::print("error       {:.2g} rad of theta_r, {:.2g} of all joints and the base\n",
               s.theta_r_error, s.configuration_error);
    fmt::print("deflection  {:.2g} m or rad from the expected pose of the end effector\n",
               s.deflection_error);
  }
  if (std::isfinite(s.saturated)) {
    fmt::print(
        "efforts     saturated {:.0f} %, request relaxed {:.0f} % of the hold, shortfall {:.2g}\n",
        100 * s.saturated, 100 * s.relaxed, s.shortfall);
  }
  fmt::print("limits      exceeded by {:.2g}\n", s.violation);
  print_end(run);
}

int print_heaviest(const SimulateOptions& options, const Answer& answer) {
  const std::string& problem = answer.task->name;
  const HeaviestLoad load = heaviest_load(answer, options.integrator, options.tank);
  const bool ended = load.status != Status::kBestFound;
  if (options.json) {
    print_json({{"problem", problem},
                {"heaviest", load.mass},
                {"status", to_string(load.status)},
                {"reason", load.reason.str()}});
  } else {
    fmt::print("{}  virtual tank  heaviest load {}{} kg{}{}\n", problem, ended ? "at least " : "",
               load.mass, ended ? ", budget_exhausted: " : "", load.reason.c_str());
  }
  return ended ? kOtherStatus : kAnswered;
}

/// Rejects options of a load where a list states the wrenches.
void require_list_options(const Problem& problem, const SimulateOptions& options) {
  require_tank_scenarios(problem);
  reject_given(*options.command, {"--load", "--heaviest"},
               problem.name + ", a task with a list of scenarios, expected one wrench");
}

void require_planned(double planned) {
  if (planned > 0) return;
  throw std::invalid_argument(
      fmt::format("--planned: got {}, expected a value > 0: none is possible here", planned));
}

int simulate_list(const SimulateOptions& options, const Answer& answer) {
  require_planned(options.planned > 0 ? options.planned : answer.capability.beta);
  return report_experiments(
      *answer.task, options,
      simulate_scenarios(answer, options.planned, options.integrator, options.tank));
}

TankRun simulate_answer(const SimulateOptions& options, const Answer& answer) {
  const TankOptions& tank = options.tank;
  if (tank.load > 0) return simulate_load(answer, tank.load, options.integrator, tank);
  const double planned =
      options.planned > 0 ? options.planned : answer.task->c.dot(answer.capability.h);
  require_planned(planned);
  return simulate_posture(answer, planned, options.integrator, tank);
}

void require_stiff(const std::string& name) {
  const std::vector<std::string> stiff = stiff_integrators();
  if (std::find(stiff.begin(), stiff.end(), name) != stiff.end()) return;
  for (const Absent& absent : not_built_in()) {
    if (absent.name == name) find_integrator(name);  // names the missing library
  }
  throw std::invalid_argument(
      fmt::format("--integrator: got {}, expected one for stiff systems: {}", name,
                  stiff.empty() ? "none is built in" : fmt::format("{}", fmt::join(stiff, " "))));
}

int simulate_static(const Problem& task, const SimulateOptions& options) {
  if (!task.scenarios.empty()) require_list_options(task, options);
  // The controller holds the end effector at its pose for theta_r.
  const Eigen::VectorXd theta_r = theta_r_of(task, options.theta_r);
  const Problem problem = held_at(task, theta_r);
  const Answer answer = evaluate(problem, held_theta_r(task, theta_r), options.read_options());
  if (!answer.has_value()) return report(answer, options.json);
  if (answer.capability.u.size() == 0 || answer.capability.w.size() == 0) {
    throw std::invalid_argument("--measure: got " + answer.choice.measure +
                                ", expected one with a wrench");
  }
  if (!problem.scenarios.empty()) return simulate_list(options, answer);
  if (options.heaviest) return print_heaviest(options, answer);
  const TankRun run = simulate_answer(options, answer);
  if (!options.out.empty()) write_file(options.out, tank_csv(problem, run));
  (options.json ? print_object : print_text)(problem, options, run);
  // Comes last: it rejects an experiment without samples, but the answer is valid even then.
  if (!options.figure.empty()) {
    write_file(options.figure, tank_figure(problem, {{problem.name, &run}}));
  }
  return run.status == Status::kReached ? kAnswered : kOtherStatus;
}

int simulate(SimulateOptions& options) {
  require_stiff(options.integrator);
  const Problem problem = load_apart(options.choice.problem, options.source, options.motion,
                                     {{"--theta-r", options.theta_r.value_or("")}},
                                     {{"--out", options.out}, {"--figure", options.figure}});
  if (problem.contact) {
    throw std::invalid_argument("problem: got " + problem.name +
                                ", expected one without a second contact");
  }
  options.dies.read(problem.robot, options.tank);
  if (problem.motion) return simulate_motion(problem, options);
  if (options.interpolation) {
    throw std::invalid_argument("--interpolation: got '" + *options.interpolation +
                                "', expected none: " + problem.name + " is a static task");
  }
  return simulate_static(problem, options);
}

using Accepts = bool (*)(double);
bool positive(double value) { return value > 0 && std::isfinite(value); }
bool not_negative(double value) { return value >= 0 && std::isfinite(value); }
bool seconds(double value) { return value >= 0.1 && value <= 1000; }

CLI::Validator number(Accepts accepts, const char* expected) {
  return {[accepts, expected](const std::string& text) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && accepts(value)) return {};
            return fmt::format("got {}, expected {}", text, expected);
          },
          "NUMBER"};
}

void add_imperfections(CLI::App& command, Imperfections& imperfections) {
  command
      .add_option("--thrust-efficiency", imperfections.thrust_efficiency,
                  "thrust over commanded thrust")
      ->capture_default_str()
      ->check(number(not_negative, "a number >= 0"));
  command
      .add_option("--thrust-noise", imperfections.thrust_noise,
                  "standard deviation of each thruster [N]")
      ->capture_default_str()
      ->check(number(not_negative, "a number >= 0"));
  command.add_option("--seed", imperfections.seed, "seed of the noise")
      ->capture_default_str()
      ->check(reject_seed);
}

/// Options of the experiment.
void add_trajectory_options(CLI::App& command, SimulateOptions& options) {
  add_theta_r(command, options.theta_r);
  options.motion.add(command);
  command.add_option("--interpolation", options.interpolation,
                     "interpolation between the instants of a trajectory: linear or spline");
}

void add_times(CLI::App& command, TankOptions& tank) {
  for (auto [name, value] : {std::pair("--ramp", &tank.ramp), std::pair("--hold", &tank.hold)}) {
    command.add_option(name, *value, "s")
        ->capture_default_str()
        ->check(number(seconds, "between 0.1 and 1000 s"));
  }
}

}  // namespace

void print_end(const TankRun& run) {
  const TankSummary& s = run.summary;
  if (!s.missed.empty()) fmt::print("missed      {}\n", s.missed);
  fmt::print("{}", s.held ? "held" : "not held");
  if (run.status != Status::kReached) {
    fmt::print(", {}: {}", to_string(run.status), run.reason.c_str());
  } else if (!run.samples.empty()) {
    fmt::print(", ended at {:g} s", run.samples.back().t);
  }
  fmt::print("; in {:.3g} s, {} evaluations\n", run.total_s, run.evaluations);
}

void add_simulate(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App& command = *app.add_subcommand("simulate",
                                          "runs the experiment in the virtual tank: ramp, hold, "
                                          "ramp, or a trajectory of a task in time");
  options->command = &command;
  options->add_case(command);
  options->add_json(command);
  options->source.add(command);
  add_trajectory_options(command, *options);
  CLI::Option* planned =
      command
          .add_option("--planned", options->planned,
                      "wrench along c (default: the capability, or the value of the trajectory)")
          ->check(number(positive, "a number > 0"));
  CLI::Option* load =
      command
          .add_option("--load", options->tank.load,
                      "mass [kg] that the end effector carries, free of the load cell")
          ->check(number(positive, "a mass > 0"))
          ->excludes(planned);
  CLI::Option* heaviest = command
                              .add_flag("--heaviest", options->heaviest,
                                        "find only the heaviest load in whole kilograms")
                              ->excludes(planned)
                              ->excludes(load);
  add_times(command, options->tank);
  options->dies.add(command, options->tank);
  command
      .add_option("--integrator", options->integrator,
                  "integrator, one of those that 'maxwrench list' prints")
      ->capture_default_str();
  command.add_option("--out", options->out, "CSV file for the time series")->excludes(heaviest);
  command.add_option("--figure", options->figure, "SVG file for the curves over time")
      ->excludes(heaviest);
  command.add_flag("--invert-lag", options->tank.invert_lag,
                   "request only efforts that the thrusters reach behind their lag, from commands "
                   "within the limits");
  add_imperfections(command, options->tank.imperfections);
  command.callback([options, &exit_status] {
    const CtrlC ctrl_c;
    options->tank.interrupted = ctrl_c.asked();
    exit_status = simulate(*options);
  });
}

}  // namespace maxwrench
