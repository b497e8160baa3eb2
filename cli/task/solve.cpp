#include "maxwrench/solve.h"

#include <memory>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/task/explain_option.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

struct SolveOptions : CommonOptions {
  MotionOptions motion;
  ProblemOptions source;
  std::string out;
  ExplainOption explain;
};

int solve(const SolveOptions& options, const Problem& problem) {
  Options how = options.read_options();
  static_cast<Case&>(how) = with_search(problem, how);
  Progress progress("solve", static_cast<double>(how.budget));
  CtrlC ctrl_c;
  how.progress = progress.counter();
  how.interrupted = ctrl_c.asked();
  const Answer answer = solve(problem, how);
  progress.finish();
  if (!options.out.empty() && answer.has_posture()) {
    write_file(options.out, knots_csv(problem, answer.trajectory.knots));
  }
  return options.explain.report(answer, options.json);
}

}  // namespace

void add_solve(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App& command = *app.add_subcommand(
      "solve", "searches for the posture or trajectory with the largest capability");
  options->add_case(command);
  options->add_search(command);
  options->motion.add(command);
  options->source.add(command);
  options->explain.add(command);
  options->add_threads(command);
  options->add_json(command);
  command.add_option("--out", options->out, "CSV file for the table of theta_r")
      ->check(reject_empty);
  command.callback([options, &exit_status] {
    require_apart(options->source.inputs(options->choice.problem), {{"--out", options->out}});
    Problem problem = options->source.load(options->choice.problem);
    options->motion.change(problem);
    if (problem.motion) {
      require_apart({{"path.file", problem.motion->path_file}}, {{"--out", options->out}});
    }
    exit_status = solve(*options, problem);
  });
}

}  // namespace maxwrench
