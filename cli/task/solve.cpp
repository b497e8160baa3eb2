#include "maxwrench/solve.h"

#include <memory>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/proof/trajectory_proofs.h"
#include "cli/task/explain_option.h"
#include "cli/task/held_option.h"
#include "cli/task/load_and_solve.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

struct SolveOptions : CommonOptions {
  MotionOptions motion;
  ProblemOptions source;
  std::string out;
  ExplainOption explain;
  HeldOption held;
  bool proven = false;
};

void write_knots(const SolveOptions& options, const Problem& problem, const Answer& answer) {
  if (options.out.empty() || !answer.has_posture()) return;
  write_file(options.out, knots_csv(problem, answer.trajectory.knots));
}

int solve_proven(const SolveOptions& options, const Problem& problem) {
  if (!problem.motion) {
    throw std::invalid_argument("--proven: got " + problem.name +
                                ", a static task, expected a task in time (certify proves others)");
  }
  const TrajectoryProof proof =
      solve_proven_with_progress("solve", problem, options.read_options());
  write_knots(options, problem, proof.answer);
  return report_proven(proof, options.json);
}

int solve(const SolveOptions& options, const Problem& problem) {
  if (options.proven) return solve_proven(options, problem);
  if (options.held.tank()) {
    const HeldTrajectory held = options.held.solve(problem, options.read_options());
    write_knots(options, problem, held.answer);
    return HeldOption::report(held, options.json);
  }
  const Answer answer = solve_with_progress("solve", problem, options.read_options());
  write_knots(options, problem, answer);
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
  options->held.add(command);
  options->add_threads(command);
  options->add_json(command);
  command.add_option("--out", options->out, "CSV file for the table of theta_r")
      ->check(reject_empty);
  command
      .add_flag("--proven", options->proven,
                "of a task in time: prove what the trajectory exerts at every instant")
      ->excludes("--explain")
      ->excludes("--worth");
  command.get_option("--explain")->excludes("--worth");
  command.callback([options, &exit_status] {
    exit_status = solve(*options, load_apart(options->choice.problem, options->source,
                                             options->motion, {}, {{"--out", options->out}}));
  });
}

}  // namespace maxwrench
