#include <fmt/format.h>

#include <memory>

#include "benchmarks/table.h"
#include "cli/cli.h"
#include "cli/figures.h"
#include "problems/loader.h"

namespace maxwrench {
namespace {

struct PlotOptions {
  std::string problem, out;
  std::optional<std::string> theta_r;
};

void plot(const PlotOptions& options) {
  const Problem problem = load_problem(options.problem);
  const Eigen::VectorXd theta_r = theta_r_of(problem, options.theta_r);
  const std::string svg = figure(problem, {{problem.name, theta_r}});
  if (options.out.empty()) {
    fmt::print("{}", svg);
  } else {
    write_file(options.out, svg);
  }
}

}  // namespace

void add_plot(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App& command = *app.add_subcommand("plot", "draw a posture with its wrench sets as SVG");
  command.add_option("problem", options->problem, "shipped name or task file")->required();
  command.add_option("--theta-r", options->theta_r,
                     "redundant coordinates, separated by commas (default: those of the task)");
  command.add_option("--out", options->out, "file to write (default: stdout)");
  command.callback([options, &exit_status] {
    plot(*options);
    exit_status = kAnswered;
  });
}

}  // namespace maxwrench
