#include <fmt/format.h>

#include <memory>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/task/load_and_solve.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

struct PlotOptions {
  std::string problem, out;
  std::optional<std::string> theta_r;
  MotionOptions motion;
  ProblemOptions source;
};

/// Empty, with a line on stderr, if there is no such posture.
std::optional<std::string> draw_static(const Problem& problem, const PlotOptions& options) {
  const Eigen::VectorXd theta_r = theta_r_of(problem, options.theta_r);
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(theta_r);
  if (posture.status != Status::kValid) {
    fmt::print(stderr, "{}: {}\n", to_string(posture.status), describe_violation(problem, posture));
    return {};
  }
  return figure(problem, {{problem.name, theta_r}});
}

/// The same for a trajectory: its start, its middle (for an impulse the peak) and its end.
std::optional<std::string> draw_trajectory(const Problem& problem, const PlotOptions& options) {
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make);
  const Trajectory& trajectory = evaluator.evaluate(knots_of(problem, options.theta_r));
  if (trajectory.status == Status::kInvalidPosture) {
    fmt::print(stderr, "{}: {}\n", to_string(trajectory.status), trajectory.reason.c_str());
    return {};
  }
  return trajectory_figure(problem, trajectory, telling_times(*problem.motion, trajectory));
}

/// Returns status 1 if there is no such posture: showing another one would be misleading.
int plot(const PlotOptions& options) {
  const Problem problem =
      load_apart(options.problem, options.source, options.motion,
                 {{"--theta-r", options.theta_r.value_or("")}}, {{"--out", options.out}});
  const std::optional<std::string> drawn =
      problem.motion ? draw_trajectory(problem, options) : draw_static(problem, options);
  if (!drawn) return kOtherStatus;
  const std::string& svg = *drawn;
  if (options.out.empty()) {
    fmt::print("{}", svg);
  } else {
    write_file(options.out, svg);
  }
  return kAnswered;
}

}  // namespace

void add_plot(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App& command = *app.add_subcommand(
      "plot", "draws a posture with its wrench sets, or the postures of a trajectory, as SVG");
  command.add_option("problem", options->problem, kProblemHelp)->required();
  add_theta_r(command, options->theta_r);
  options->source.add(command);
  options->motion.add(command);
  command.add_option("--out", options->out, "SVG file to write (default: stdout)")
      ->check(reject_empty);
  command.callback([options, &exit_status] { exit_status = plot(*options); });
}

}  // namespace maxwrench
