#include <memory>
#include <stdexcept>

#include "solvers/solve/plan_row.h"
#include "solvers/solve/row.h"
#include "benchmarks/write_file.h"
#include "cli/cli.h"
#include "cli/motion_options.h"
#include "cli/output.h"
#include "cli/state.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/mps.h"

namespace maxwrench {
namespace {

struct EvalOptions : CommonOptions {
  std::optional<std::string> theta_r;
  std::string state, write;
  bool ignore_collision = false;
  MotionOptions motion;
};

/// Writes the program of the posture, if there is one.
void write_program(const EvalOptions& options, const Problem& problem, const Method& method,
                   const Eigen::VectorXd& theta_r) {
  if (method.choice.measure != "linf_polytope") {
    throw std::invalid_argument("--write: got measure " + method.choice.measure +
                                ", expected linf_polytope");
  }
  PostureEvaluator model(problem, !options.ignore_collision);
  WrenchProgram program = make_wrench_program(problem, method.choice.wrench);
  Capability capability;
  const Posture& posture =
      evaluate_best(model, theta_r, *method.make_measure(), false, program, capability);
  if (posture.status != Status::kValid) return;
  set_posture(posture, program);
  write_file(options.write, wrench_program_mps(problem, program));
}

int eval_plan(const EvalOptions& options, const Problem& problem, const Case& c) {
  require_apart(
      {{"path.file", problem.motion->path_file}, {"--theta-r", options.theta_r.value_or("")}},
      {{"--write", options.write}});
  const PlanMethod method = resolve_plan(problem, c);
  const PlanRow row =
      evaluate_plan(problem, method, knots_of(problem, options.theta_r), !options.ignore_collision);
  if (!options.write.empty() && row.status != Status::kInvalidPosture) {
    write_file(options.write, plan_program_mps(problem, row.program));
  }
  return report(problem, row, options.json);
}

int eval(const EvalOptions& options) {
  require_apart({{"problem", options.choice.problem}}, {{"--write", options.write}});
  if (!options.state.empty()) {
    return report_state(load_problem(options.choice.problem), options.state, options.json);
  }
  Problem problem = load_problem(options.choice.problem);
  options.motion.change(problem);
  Case c = options.read_case();
  c.search.clear();  // none is used
  if (problem.motion) return eval_plan(options, problem, c);
  const Method method = resolve(problem, c);
  const Eigen::VectorXd theta_r = theta_r_of(problem, options.theta_r);
  if (!options.write.empty()) write_program(options, problem, method, theta_r);
  return report(problem, evaluate(problem, method, theta_r, !options.ignore_collision),
                options.json);
}

}  // namespace

void add_eval(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App& command = *app.add_subcommand("eval", "the capability of one posture or plan");
  options->add_case(command);
  options->add_json(command);
  add_theta_r(command, options->theta_r);
  options->motion.add(command);
  command.add_option("--write", options->write, "the linear program, as an MPS file")
      ->check(refuse_empty);
  command.add_flag("--ignore-collision", options->ignore_collision,
                   "evaluate a posture that collides too; of a plan, look for no collisions");
  CLI::Option& state =
      *command.add_option("--state", options->state,
                          "M, tau_d and J at the motion in this file, instead of a capability");
  for (const char* other : {"--theta-r", "--measure", "--wrench", "--lp", "--write",
                            "--ignore-collision", "--scheme", "--t-h"}) {
    state.excludes(command.get_option(other));
  }
  command.callback([options, &exit_status] { exit_status = eval(*options); });
}

}  // namespace maxwrench
