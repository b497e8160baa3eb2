#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/table.h"
#include "cli/cli.h"
#include "cli/tank_experiment.h"
#include "problems/loader.h"

namespace maxwrench {
namespace {

struct SimulateOptions : CommonOptions {
  std::string theta_r, out, figure, integrator = "cvode";
  double planned = 0;  ///< zero: the capability
  bool heaviest = false;
  TankOptions tank;
};

void print_summary(const Problem& problem, const SimulateOptions& options, const TankRun& run) {
  const TankSummary& s = run.summary;
  if (options.json) {
    const nlohmann::ordered_json object = {{"problem", problem.name},
                                           {"integrator", options.integrator},
                                           {"status", to_string(run.status)},
                                           {"reason", run.reason},
                                           {"unit", problem.unit()},
                                           {"planned", s.planned},
                                           {"mean", s.mean},
                                           {"low", s.low},
                                           {"high", s.high},
                                           {"joint_error", s.joint_error},
                                           {"position_error", s.position_error},
                                           {"relaxed", s.relaxed},
                                           {"shortfall", s.shortfall},
                                           {"violation", s.violation},
                                           {"held", s.held},
                                           {"wall_s", run.total_s},
                                           {"version", MAXWRENCH_VERSION}};
    fmt::print("{}\n", object.dump());
    return;
  }
  fmt::print("{}  virtual tank  integrator {}\n", problem.name, options.integrator);
  fmt::print("planned     {:.5f} {}\n", s.planned, problem.unit());
  fmt::print("reading     {:.5f}, between {:.5f} and {:.5f}\n", s.mean, s.low, s.high);
  fmt::print("posture     within {:.2g} rad of theta_r, end effector within {:.2g} m\n",
             s.joint_error, s.position_error);
  fmt::print("limits      left by {:.2g}; no efforts for {:.0f} % of the hold, mean lack {:.2g}\n",
             s.violation, 100 * s.relaxed, s.shortfall);
  fmt::print("{}  in {:.3g} s, {} evaluations\n", s.held ? "held" : "not held", run.total_s,
             run.evaluations);
}

int simulate(const SimulateOptions& options) {
  Case c = options.read_case();
  c.search.clear();  // none is used
  const Problem problem = load_problem(c.problem);
  const Eigen::VectorXd theta_r = options.theta_r.empty()
                                      ? problem.theta_r_default
                                      : parse_numbers("--theta-r", options.theta_r);
  const Row row = evaluate(problem, c, theta_r);
  if (!row.has_value()) return report(problem, row, options.json);
  if (row.capability.u.size() == 0 || row.capability.w.size() == 0) {
    throw std::invalid_argument("--measure: got " + c.measure + ", expected one with a wrench");
  }
  if (options.heaviest) {
    fmt::print("{} kg\n", heaviest_load(problem, row, options.integrator, options.tank));
    return kAnswered;
  }
  const double planned = options.planned > 0 ? options.planned : row.capability.beta;
  if (planned <= 0) {
    throw std::invalid_argument(
        fmt::format("--planned: got {}, expected a value > 0: none is possible here", planned));
  }
  const TankRun run = simulate_tank(problem, row, planned, options.integrator, options.tank);
  if (!options.out.empty()) write_file(options.out, tank_csv(problem, run));
  if (!options.figure.empty()) {
    write_file(options.figure, tank_figure(problem, {{problem.name, &run}}));
  }
  print_summary(problem, options, run);
  return run.status == Status::kOptimal ? kAnswered : kOtherStatus;
}

void add_imperfections(CLI::App& command, Imperfections& imperfections) {
  command
      .add_option("--thrust-efficiency", imperfections.thrust_efficiency,
                  "thrust over commanded thrust")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 2.0));
  command
      .add_option("--thrust-noise", imperfections.thrust_noise,
                  "standard deviation of each thruster [N]")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seed", imperfections.seed, "of the noise")->capture_default_str();
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App& command = *app.add_subcommand(
      "simulate", "the static experiment on the simulated robot: ramp, hold, ramp");
  options->add_case(command);
  options->add_json(command);
  command.add_option("--theta-r", options->theta_r,
                     "redundant coordinates, separated by commas (default: those of the task)");
  command.add_option("--planned", options->planned, "wrench along c (default: the capability)")
      ->check(CLI::PositiveNumber);
  command.add_flag("--released", options->tank.release,
                   "nothing holds the end effector, which carries the wrench as a load");
  command.add_flag("--heaviest", options->heaviest,
                   "the heaviest load that it carries, in whole kg of 9.81 N");
  command.add_option("--ramp", options->tank.ramp, "s")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  command.add_option("--hold", options->tank.hold, "s")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  command.add_option("--integrator", options->integrator, "see maxwrench list")
      ->capture_default_str();
  command.add_option("--out", options->out, "the time series, as a CSV file");
  command.add_option("--figure", options->figure, "c'h over time, as an SVG file");
  add_imperfections(command, options->tank.imperfections);
  command.callback([options, &exit_status] { exit_status = simulate(*options); });
}

}  // namespace maxwrench
