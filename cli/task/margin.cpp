#include "maxwrench/margin.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "maxwrench/figures.h"
#include "maxwrench/motion_table.h"
#include "maxwrench/solve.h"

namespace maxwrench {
namespace {

struct MarginOptions : CommonOptions {
  ProblemOptions source;
  MotionOptions motion;
  std::optional<std::string> theta_r;
  std::vector<std::string> ball;
  std::string table, frame = "world", out, figure;
  int instants_per_interval = 1;
  bool task_wrench = false, nominal = false;
};

MarginSet set_of(const MarginOptions& options) {
  if (options.task_wrench) {
    MarginSet set;
    set.of_task = true;
    return set;
  }
  return margin_ball(
      options.ball.empty() ? std::vector<std::string>{"fx", "fy", "fz"} : options.ball,
      options.frame == "end_effector");
}

/// The instants of the table or of a trajectory of the task, and in words where they come from.
std::pair<std::vector<Instant>, std::string> instants_of(const Problem& problem,
                                                         const MarginOptions& options) {
  if (!options.table.empty()) {
    std::string rates;
    std::vector<Instant> instants =
        load_motion(options.table, problem, options.instants_per_interval, &rates);
    return {std::move(instants), options.table + ", " + rates};
  }
  if (!problem.motion) {
    throw std::invalid_argument("--motion: got nothing, expected a table of a motion for " +
                                problem.name + ", a static task");
  }
  Options how;
  how.check_collision = false;
  const Answer answer = evaluate(problem, knots_of(problem, options.theta_r), how);
  if (answer.status == Status::kInvalidPosture) {
    throw std::invalid_argument("--theta-r: got an invalid trajectory, expected one that exists: " +
                                answer.reason.str());
  }
  return {answer.trajectory.instants, fmt::format("the instants of the trajectory, scheme {}",
                                                  to_string(problem.motion->scheme))};
}

int print_margin(const MarginOptions& options) {
  std::vector<NamedFile> inputs = options.source.inputs(options.choice.problem);
  inputs.push_back({"--motion", options.table});
  inputs.push_back({"--theta-r", options.theta_r.value_or("")});
  require_apart(inputs, {{"--out", options.out}, {"--figure", options.figure}});
  Problem problem = options.source.load(options.choice.problem);
  options.motion.change(problem);
  if (options.nominal) problem = nominal(std::move(problem));
  const MarginSet set = set_of(options);
  const auto [instants, from] = instants_of(problem, options);
  const MotionMargin margin = motion_margin(problem, instants, set);
  if (!options.out.empty()) write_file(options.out, margin_csv(margin));
  if (options.json) {
    fmt::print("{}\n", to_json(margin));
  } else {
    fmt::print("motion      {}\n{}", from, summary(margin));
  }
  // Comes last: it rejects margins without a curve, but the answer is valid even then.
  if (!options.figure.empty()) write_file(options.figure, margin_figure(margin));
  return margin.status == Status::kOptimal ? kAnswered : kOtherStatus;
}

}  // namespace

void add_margin(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<MarginOptions>();
  CLI::App& command = *app.add_subcommand(
      "margin", "computes what the end effector can exert beside what a motion needs");
  command.add_option("problem", options->choice.problem, kProblemHelp)->required();
  options->add_json(command);
  add_theta_r(command, options->theta_r);
  options->motion.add(command);
  options->source.add(command);
  command
      .add_option("--motion", options->table,
                  "CSV file of the motion: t, then joints by name, or also base_x .. base_yaw; "
                  "NAME_dot and NAME_ddot if they are known (default: the trajectory of a task in "
                  "time)")
      ->check(reject_empty)
      ->excludes("--theta-r", "--scheme", "--t-h");
  command
      .add_option("--instants-per-interval", options->instants_per_interval,
                  "with --motion: instants for each row of the table")
      ->needs("--motion")
      ->capture_default_str()
      ->check(whole_number(1, kMostMotionInstants));
  command
      .add_option("--ball", options->ball,
                  "axes of any force or of any torque, such as fx,fy (default: fx,fy,fz)")
      ->delimiter(',');
  command.add_option("--ball-frame", options->frame, "axes of the ball")
      ->check(CLI::IsMember({"world", "end_effector"}))
      ->capture_default_str();
  command
      .add_flag("--task-wrench", options->task_wrench,
                "the wrenches of the task in place of a ball")
      ->excludes("--ball", "--ball-frame");
  command.add_flag("--nominal", options->nominal, "without uncertainty and loss of the task");
  command.add_option("--out", options->out, "CSV file for the margins")->check(reject_empty);
  command.add_option("--figure", options->figure, "SVG file for the margins over time")
      ->check(reject_empty);
  command.callback([options, &exit_status] { exit_status = print_margin(*options); });
}

}  // namespace maxwrench
