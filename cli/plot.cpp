#include <fmt/format.h>

#include <memory>

#include "benchmarks/write_file.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

struct PlotOptions {
  std::string problem, out;
  std::optional<std::string> theta_r;
};

/// Status 1 if there is no such posture: another one in its place would mislead.
int plot(const PlotOptions& options) {
  require_apart({{"problem", options.problem}}, {{"--out", options.out}});
  const Problem problem = load_problem(options.problem);
  require_static(problem, "plot");
  const Eigen::VectorXd theta_r = theta_r_of(problem, options.theta_r);
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(theta_r);
  if (posture.status != Status::kValid) {
    fmt::print(stderr, "{}: {}\n", to_string(posture.status), describe_violation(problem, posture));
    return kOtherStatus;
  }
  const std::string svg = figure(problem, {{problem.name, theta_r}});
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
  CLI::App& command = *app.add_subcommand("plot", "draw a posture with its wrench sets as SVG");
  command.add_option("problem", options->problem, "shipped name or task file")->required();
  command.add_option("--theta-r", options->theta_r,
                     "redundant coordinates, separated by commas (default: those of the task)");
  command.add_option("--out", options->out, "file to write (default: stdout)")->check(refuse_empty);
  command.callback([options, &exit_status] { exit_status = plot(*options); });
}

}  // namespace maxwrench
