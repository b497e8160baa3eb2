#include "maxwrench/sensitivity.h"

#include <fmt/format.h>

#include <memory>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "drawing/bars.h"
#include "maxwrench/task.h"
#include "problems/make/bad_value.h"
#include "problems/make/losses.h"

namespace maxwrench {
namespace {

struct SensitivityOptions : CommonOptions {
  std::optional<std::string> theta_r;
  std::string figure, joints = "limp";
  LossSpec loss;
  ProblemOptions source;
};

/// Bars of the best values, with dashes for the values at the given posture.
std::string figure_of(const Problem& problem, const Sensitivity& result) {
  BarGroup group{result.all.at_posture.unit, {}};
  const auto add = [&group](const std::string& name, const LossEffect& effect) {
    if (!effect.best.has_value()) return;
    Bar bar{name, effect.best.beta(), {}};
    if (effect.at_posture.has_value()) bar.measured.push_back(effect.at_posture.beta());
    group.bars.push_back(bar);
  };
  for (const LossEffect& effect : result.effects) {
    add(effect.name.empty() ? "nothing lost" : effect.name, effect);
  }
  add("any of these", result.all);
  return draw_bars(problem.name + ": the best wrench with each loss", {group},
                   "at the given posture");
}

/// The limits of each loss. Bad values are named by the options that set them.
std::vector<ScenarioLimits> limits_of(const SensitivityOptions& options, const Robot& robot) {
  LossSpec loss = options.loss;
  loss.joints_lock = options.joints == "locked";
  try {
    return limits_of_each_loss(loss, robot);
  } catch (const BadValue& bad) {
    const std::string name = bad.key().substr(bad.key().find('.') + 1);
    throw std::invalid_argument(bad_value_line("--" + name, bad.got(), bad.expected()));
  }
}

int print_sensitivity(const SensitivityOptions& options) {
  require_apart(options.source.inputs(options.choice.problem), {{"--figure", options.figure}});
  const Problem problem = options.source.load(options.choice.problem);
  require_static(problem, "sensitivity");
  const std::vector<ScenarioLimits> limits = limits_of(options, problem.robot);
  CtrlC ctrl_c;
  Options how = options.read_options();
  how.interrupted = ctrl_c.asked();
  const Sensitivity result =
      sensitivity(problem, theta_r_of(problem, options.theta_r), limits, how);
  if (!options.figure.empty()) write_file(options.figure, figure_of(problem, result));
  fmt::print("{}", options.json ? to_json(result) + "\n" : summary(result));
  return result.all.best.has_value() ? kAnswered : kOtherStatus;
}

}  // namespace

void add_sensitivity(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<SensitivityOptions>();
  CLI::App& command =
      *app.add_subcommand("sensitivity", "ranks the actuators by what their loss costs");
  options->add_case(command);
  options->add_search(command);
  options->add_threads(command);
  options->add_json(command);
  add_theta_r(command, options->theta_r);
  options->source.add(command);
  command
      .add_option("--actuators", options->loss.actuators,
                  "names of actuators, 'thrusters' or 'joints'; the default is thrusters")
      ->delimiter(',');
  command.add_option("--joints-are", options->joints, "what a lost joint is")
      ->check(CLI::IsMember({"limp", "locked"}))
      ->capture_default_str();
  command.add_option("--friction", options->loss.friction, "what a limp joint resists [N m or N]");
  command.add_option("--brake", options->loss.brake, "what a locked joint resists [N m or N]");
  command.add_option("--figure", options->figure, "SVG file for a bar of each loss")
      ->check(reject_empty);
  command.callback([options, &exit_status] { exit_status = print_sensitivity(*options); });
}

}  // namespace maxwrench
