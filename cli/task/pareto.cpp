#include "maxwrench/pareto.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/task/problem_options.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

struct ParetoOptions : CommonOptions {
  std::vector<std::string> against;
  std::string against_measure, against_wrench, out, figure;
  FrontPlan plan;
  bool compromise = false;
};

int print_front(const ParetoOptions& options) {
  std::vector<NamedFile> inputs = {{"problem", options.choice.problem}};
  for (const std::string& task : options.against) inputs.push_back({"--against", task});
  require_apart(inputs, {{"--out", options.out}, {"--figure", options.figure}});
  Options how = options.read_options();
  std::vector<Goal> goals;
  goals.push_back({load_problem(options.choice.problem), how.measure, how.wrench, how.solver});
  for (const std::string& task : options.against) {
    Goal goal{load_problem(task), how.measure, how.wrench, how.solver};
    if (!options.against_measure.empty()) goal.measure = options.against_measure;
    if (!options.against_wrench.empty()) goal.wrench = parse_wrench(options.against_wrench);
    goals.push_back(std::move(goal));
  }
  for (const Goal& goal : goals) require_static(goal.task, "pareto");
  FrontPlan plan = options.plan;
  if (options.compromise || goals.size() > 2) plan.points = 0;
  CtrlC ctrl_c;
  how.interrupted = ctrl_c.asked();
  const Front front = pareto(goals, plan, how);
  if (!options.out.empty()) write_file(options.out, front_csv(front));
  if (!options.figure.empty() && !front.points.empty()) {
    write_file(options.figure, front_figure(front));
  }
  fmt::print("{}", options.json ? to_json(front) + "\n" : summary(front));
  return front.status == Status::kBestFound ? kAnswered : kOtherStatus;
}

}  // namespace

void add_pareto(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<ParetoOptions>();
  CLI::App& command = *app.add_subcommand(
      "pareto", "finds what one posture can give to two tasks, or to several at once");
  options->add_case(command);
  options->add_search(command);
  command.get_option("--search")
      ->description("search of each angle, or stages joined by + (default: crs2+cmaes)");
  command.get_option("--budget")->description("evaluation budget of each angle (default: 20000)");
  options->add_threads(command);
  options->add_json(command);
  command
      .add_option("others,--against", options->against,
                  "the other task, or several for one posture that suits all")
      ->required();
  command.add_option("--against-measure", options->against_measure,
                     "measure of the other tasks (default: --measure)");
  command.add_option("--against-wrench", options->against_wrench,
                     "wrench of the other tasks (default: --wrench)");
  command.add_option("--points", options->plan.points, "number of weights of two tasks")
      ->capture_default_str()
      ->check(whole_number(2, kMostFrontPoints));
  command.add_flag("--compromise", options->compromise,
                   "only the posture with the best worst share of each task's own best");
  command.add_flag("--certify", options->plan.bound, "also prove a bound for each weight");
  command.add_option("--gap", options->plan.gap, "the gap at which such a proof is complete")
      ->capture_default_str();
  command.add_option("--time", options->plan.seconds, "seconds after which such a proof ends")
      ->capture_default_str();
  command.add_option("--out", options->out, "CSV file for the points")->check(reject_empty);
  command.add_option("--figure", options->figure, "SVG file for the front")->check(reject_empty);
  command.callback([options, &exit_status] { exit_status = print_front(*options); });
}

}  // namespace maxwrench
