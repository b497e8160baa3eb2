#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/task/explain_option.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "cli/task/state.h"
#include "lib/scenario/scenario_list.h"
#include "maxwrench/mps.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

struct EvalOptions : CommonOptions {
  std::optional<std::string> theta_r;
  std::string state, write;
  bool ignore_collision = false, nominal = false, scenarios = false;
  std::optional<long> sample;
  std::optional<double> guaranteed;
  std::string models;
  MotionOptions motion;
  ProblemOptions source;
  ExplainOption explain;
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

void require_program(const Problem& problem, const Options& options) {
  require_no_scenarios(problem, "--write");
  if (options.measure == "linf_polytope") return;
  throw std::invalid_argument("--write: got measure " + options.measure +
                              ", expected linf_polytope");
}

Answer answer_of(const Problem& problem, const EvalOptions& options, const Options& how) {
  if (options.source.gives_joints()) {
    return evaluate_posture(
        problem, options.source.positions(problem.robot, is_urdf(options.choice.problem)), how);
  }
  if (problem.motion) return evaluate(problem, knots_of(problem, options.theta_r), how);
  return evaluate(problem, theta_r_of(problem, options.theta_r), how);
}

void require_scenarios(const Problem& problem, const EvalOptions& options) {
  if (!problem.scenarios.empty()) return;
  throw std::invalid_argument(fmt::format(
      "--{}: got {}, a task without a list of scenarios, expected one with wrench.set, ball, "
      "uncertainty, loss or payload",
      options.scenarios ? "scenarios" : "sample", problem.name));
}

/// Prints the answer, with what the options ask of its scenarios.
int report_scenarios(const EvalOptions& options, const Answer& answer) {
  const bool valid = answer.task->motion ? answer.trajectory.status != Status::kInvalidPosture
                                         : answer.posture.status == Status::kValid;
  if (options.scenarios && valid) {
    const std::vector<ScenarioEnds> ends = scenario_ends(answer);
    fmt::print("{}", options.json ? to_json(answer, ends) + "\n" : summary(answer) + summary(ends));
  } else if (options.sample && valid) {
    const ScenarioSample sample =
        sample_scenarios(answer, *options.sample, options.choice.seed, options.guaranteed);
    if (!options.models.empty()) write_file(options.models, sample_csv(sample));
    fmt::print("{}",
               options.json ? to_json(answer, sample) + "\n" : summary(answer) + summary(sample));
  } else {
    return options.explain.report(answer, options.json);
  }
  return answer.answered() ? kAnswered : kOtherStatus;
}

int eval(EvalOptions& options) {
  options.explain.take_share(options.source.at);
  require_apart(options.source.inputs(options.choice.problem),
                {{"--write", options.write}, {"--models", options.models}});
  Problem problem = options.source.load(options.choice.problem, true);
  if (!options.state.empty()) return report_state(problem, options.state, options.json);
  options.motion.change(problem);
  if (options.nominal) problem = nominal(std::move(problem));
  Options how = options.read_options();
  how.check_collision = !options.ignore_collision;
  if (problem.motion) {
    require_apart(
        {{"path.file", problem.motion->path_file}, {"--theta-r", options.theta_r.value_or("")}},
        {{"--write", options.write}});
  }
  if (!options.write.empty()) require_program(problem, how);
  if (options.scenarios || options.sample) require_scenarios(problem, options);
  const Answer answer = answer_of(problem, options, how);
  if (!options.write.empty()) write_program(options, answer);
  return report_scenarios(options, answer);
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
  options->source.add(command);
  options->explain.add(command);
  for (const char* joints : {"--joints", "--posture"}) {
    command.get_option(joints)->excludes(command.get_option("--theta-r"));
  }
  command.add_option("--write", options->write, "MPS file for the linear program")
      ->check(reject_empty);
  command.add_flag("--ignore-collision", options->ignore_collision,
                   "evaluate colliding postures, too; do not check trajectories for collisions");
  command.add_flag("--nominal", options->nominal, "without uncertainty and loss of the task");
  command
      .add_flag("--scenarios", options->scenarios, "list the interval of each scenario of the task")
      ->excludes("--explain");
  command
      .add_option("--sample", options->sample,
                  "draw so many models from the uncertainty and the losses of the task")
      ->check(CLI::Range(1L, 10'000'000L))
      ->excludes("--explain", "--scenarios");
  command.add_option("--seed", options->choice.seed, "with --sample: seed of the random numbers")
      ->check(reject_seed)
      ->needs("--sample");
  command
      .add_option("--guaranteed", options->guaranteed,
                  "with --sample: the value that models are compared with (default: beta)")
      ->check(reject_empty)
      ->needs("--sample");
  command
      .add_option("--models", options->models,
                  "with --sample: CSV file for the value of each model")
      ->check(reject_empty)
      ->needs("--sample");
  CLI::Option& state = *command.add_option(
      "--state", options->state,
      "print M, tau_d and J for the motion in this file instead of a capability");
  for (const char* other : {"--theta-r", "--measure", "--wrench", "--solver", "--write",
                            "--ignore-collision", "--scheme", "--t-h", "--joints", "--posture",
                            "--explain", "--nominal", "--scenarios", "--sample"}) {
    state.excludes(command.get_option(other));
  }
  command.callback([options, &exit_status] { exit_status = eval(*options); });
}

}  // namespace maxwrench
