#include <memory>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/task/motion_options.h"
#include "cli/task/state.h"
#include "maxwrench/load.h"
#include "maxwrench/mps.h"
#include "maxwrench/solve.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

struct EvalOptions : CommonOptions {
  std::optional<std::string> theta_r;
  std::string state, write;
  bool ignore_collision = false;
  MotionOptions motion;
};

/// Writes the linear program of the posture or trajectory, if there is one.
void write_program(const EvalOptions& options, const Answer& answer) {
  const Problem& problem = *answer.task;
  if (answer.status == Status::kInvalidPosture) return;
  if (problem.motion) {
    write_file(options.write, trajectory_program_mps(problem, answer.program));
    return;
  }
  WrenchProgram program = make_wrench_program(problem, answer.choice.wrench);
  set_posture(answer.posture, program);
  write_file(options.write, wrench_program_mps(problem, program));
}

void require_program(const Options& options) {
  if (options.measure == "linf_polytope") return;
  throw std::invalid_argument("--write: got measure " + options.measure +
                              ", expected linf_polytope");
}

int eval(const EvalOptions& options) {
  require_apart({{"problem", options.choice.problem}}, {{"--write", options.write}});
  if (!options.state.empty()) {
    return report_state(load_problem(options.choice.problem), options.state, options.json);
  }
  Problem problem = load_problem(options.choice.problem);
  options.motion.change(problem);
  Options how = options.read_options();
  how.check_collision = !options.ignore_collision;
  if (problem.motion) {
    require_apart(
        {{"path.file", problem.motion->path_file}, {"--theta-r", options.theta_r.value_or("")}},
        {{"--write", options.write}});
  }
  if (!options.write.empty()) require_program(how);
  Eigen::MatrixXd theta_r;
  if (problem.motion) {
    theta_r = knots_of(problem, options.theta_r);
  } else {
    theta_r = theta_r_of(problem, options.theta_r);
  }
  const Answer answer = evaluate(problem, theta_r, how);
  if (!options.write.empty()) write_program(options, answer);
  return report(answer, options.json);
}

}  // namespace

void add_eval(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App& command =
      *app.add_subcommand("eval", "evaluates the capability of one posture or trajectory");
  options->add_case(command);
  options->add_json(command);
  add_theta_r(command, options->theta_r);
  options->motion.add(command);
  command.add_option("--write", options->write, "MPS file for the linear program")
      ->check(reject_empty);
  command.add_flag("--ignore-collision", options->ignore_collision,
                   "evaluate colliding postures, too; do not check trajectories for collisions");
  CLI::Option& state = *command.add_option(
      "--state", options->state,
      "print M, tau_d and J for the motion in this file instead of a capability");
  for (const char* other : {"--theta-r", "--measure", "--wrench", "--solver", "--write",
                            "--ignore-collision", "--scheme", "--t-h"}) {
    state.excludes(command.get_option(other));
  }
  command.callback([options, &exit_status] { exit_status = eval(*options); });
}

}  // namespace maxwrench
