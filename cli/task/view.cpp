#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/proof/prove.h"
#include "cli/task/load_and_solve.h"
#include "maxwrench/load.h"
#include "view/page.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

struct ViewOptions : CommonOptions {
  std::optional<std::string> theta_r;
  std::string out;
  bool tank = false;
  WithinOptions within;
  double seconds = ProofOptions().seconds;  ///< of the proof and the list of `within`
  MotionOptions motion;
  ProblemOptions source;
};

Answer evaluate_at(const Problem& problem, const std::optional<std::string>& theta_r,
                   const Options& how) {
  if (problem.motion) return evaluate(problem, knots_of(problem, theta_r), how);
  return evaluate(problem, theta_r_of(problem, theta_r), how);
}

void require_list(const ViewOptions& options, const Problem& problem) {
  if (problem.motion) {
    throw std::invalid_argument("--within: got " + problem.name +
                                ", a task in time, expected a static task");
  }
  options.within.require_listable(problem);
  if (!problem.dependent.empty()) {
    throw std::invalid_argument("--within: got " + problem.name +
                                ", a task with dependent joints, expected one without");
  }
}

/// The best posture with a proof, and the list of good ones if it has a value.
Answer prove_and_list(const ViewOptions& options, const Problem& problem, Options how,
                      std::optional<GoodPostures>& good) {
  CtrlC ctrl_c;
  how.interrupted = ctrl_c.asked();
  const double gap = std::min(ProofOptions().gap, kGapPart * options.within.share());
  Proof proof =
      prove_with_progress(problem, how, {.gap = gap, .seconds = options.seconds}, nullptr);
  if (!proof.answer.has_value()) return proof.answer;
  good = list_with_progress(problem, options.within, how, options.seconds, proof);
  return proof.answer;
}

/// Returns status 1 if the best posture has no value, or the given one has none; both are shown as
/// far as they exist. If no posture exists, there is no page.
int view(const ViewOptions& options, const Problem& problem) {
  const Options how = options.read_options();
  if (options.tank) require_tank(problem, how.measure, "--tank");
  if (options.within.asked()) require_list(options, problem);
  std::vector<Shown> shown;
  // First: a wrong table is found before the search.
  if (options.theta_r) shown.push_back({"given", evaluate_at(problem, options.theta_r, how)});
  shown.push_back({"default", evaluate_at(problem, {}, how)});
  std::optional<GoodPostures> good;
  const Answer best = options.within.asked() ? prove_and_list(options, problem, how, good)
                                             : solve_with_progress("view", problem, how);
  shown.insert(shown.begin(), {"best", best});
  for (Shown& each : shown) each.tank = options.tank;
  const std::vector<std::string>& packages = options.source.packages;
  const std::vector<Visual> visuals =
      read_visuals(problem.robot, {packages.begin(), packages.end()});
  nlohmann::ordered_json scene = scene_of(problem, visuals, shown);
  if (good) scene["within"] = within_json(problem, *good, options.within.share());
  if (scene["shown"].empty()) {
    const Answer& last = shown.back().answer;
    fmt::print(stderr, "{}: {}\n", to_string(last.status), last.reason.c_str());
    return kOtherStatus;
  }
  const std::string page = view_page(problem, scene);
  if (options.out.empty()) {
    fmt::print("{}", page);
  } else {
    write_file(options.out, page);
  }
  const bool given_failed = options.theta_r && !shown[1].answer.answered();
  const bool listed = !options.within.asked() || (good && good->status == Status::kProven);
  return shown[0].answer.answered() && !given_failed && listed ? kAnswered : kOtherStatus;
}

}  // namespace

void add_view(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App& command = *app.add_subcommand(
      "view", "searches as solve does, and writes one HTML file in which the robot can be turned");
  options->add_case(command);
  options->add_search(command);
  add_theta_r(command, options->theta_r);
  options->motion.add(command);
  options->source.add(command);
  options->add_threads(command);
  options->within.add_list(command);
  command.add_option("--time", options->seconds, "seconds for the proof and the list of --within")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9))
      ->needs("--within");
  command.add_flag("--tank", options->tank,
                   "add what the virtual tank reads along each trajectory of a task in time");
  command.add_option("--out", options->out, "HTML file to write (default: stdout)")
      ->check(reject_empty);
  command.callback([options, &exit_status] {
    const Problem problem =
        load_apart(options->choice.problem, options->source, options->motion,
                   {{"--theta-r", options->theta_r.value_or("")}}, {{"--out", options->out}});
    exit_status = view(*options, problem);
  });
}

}  // namespace maxwrench
