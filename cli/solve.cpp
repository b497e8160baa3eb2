#include <memory>

#include "solvers/solve/plan_row.h"
#include "solvers/solve/row.h"
#include "benchmarks/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/motion_options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

struct SolveOptions : CommonOptions {
  MotionOptions motion;
  bool names_search = false;
  std::string out;
};

/// The posture as a table, or the plan.
void write_table(const SolveOptions& options, const Problem& problem, const Eigen::MatrixXd& knots,
                 bool found) {
  if (!options.out.empty() && found) write_file(options.out, knots_csv(problem, knots));
}

int solve_posture(const SolveOptions& options, const Problem& problem) {
  Case c = options.read_case();
  if (!options.names_search) c.search = best_search(problem, c.measure);
  const Method method = resolve(problem, c);
  Progress progress("solve", method.choice.budget);
  CtrlC ctrl_c;
  const Row row =
      solve(problem, method, options.thread_count(), progress.counter(), &ctrl_c.interruption);
  progress.finish();
  write_table(options, problem, row.posture.theta_r.transpose(), row.has_posture());
  return report(problem, row, options.json);
}

int solve_motion(const SolveOptions& options, const Problem& problem) {
  Case c = options.read_case();
  if (!options.names_search) c.search = plan_searches().front().name;
  const PlanMethod method = resolve_plan(problem, c);
  Progress progress("solve", method.choice.budget);
  CtrlC ctrl_c;
  const PlanRow row =
      solve_plan(problem, method, options.thread_count(), progress.counter(), &ctrl_c.interruption);
  progress.finish();
  write_table(options, problem, row.plan.knots, row.has_plan());
  return report(problem, row, options.json);
}

}  // namespace

void add_solve(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App& command =
      *app.add_subcommand("solve", "search the posture or plan with the largest capability");
  options->add_case(command);
  options->add_search(command);
  options->motion.add(command);
  options->add_threads(command);
  options->add_json(command);
  command.add_option("--out", options->out, "table of theta_r to write, as a CSV file")
      ->check(refuse_empty);
  command.callback([options, &command, &exit_status] {
    Problem problem = load_problem(options->choice.problem);
    options->motion.change(problem);
    require_apart({{"problem", options->choice.problem},
                   {"path.file", problem.motion ? problem.motion->path_file : ""}},
                  {{"--out", options->out}});
    options->names_search = command.count("--search") > 0;
    exit_status =
        problem.motion ? solve_motion(*options, problem) : solve_posture(*options, problem);
  });
}

}  // namespace maxwrench
