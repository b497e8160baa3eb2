#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/task/load_and_solve.h"
#include "maxwrench/figures.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "view/scene/scene.h"
#include "view/still/still.h"

namespace maxwrench {
namespace {

struct PlotOptions : CommonOptions {
  std::string out, style = "shaded";
  std::optional<std::string> theta_r;
  int stills = 0;
  bool best = false;
  MotionOptions motion;
  ProblemOptions source;

  bool outline() const { return style == "outline"; }
};

Answer evaluate_given(const Problem& problem, const PlotOptions& options) {
  const Options how = options.read_options();
  if (problem.motion) return evaluate(problem, knots_of(problem, options.theta_r), how);
  return evaluate(problem, theta_r_of(problem, options.theta_r), how);
}

/// The times [s] of the stills of an answer; none for a static task.
std::vector<double> times_of(const Problem& problem, const PlotOptions& options,
                             const Answer& answer) {
  if (!problem.motion) return {};
  if (options.stills == 0) return telling_times(*problem.motion, answer.trajectory);
  std::vector<double> times;
  for (int i = 0; i < options.stills; ++i) {
    times.push_back(problem.motion->T * i / std::max(options.stills - 1, 1));
  }
  return times;
}

std::string outlines(const Problem& problem, const PlotOptions& options,
                     const std::vector<Shown>& shown) {
  if (problem.motion) {
    const Answer& answer = shown.front().answer;
    return trajectory_figure(problem, answer.trajectory, times_of(problem, options, answer));
  }
  std::vector<Panel> panels;
  for (const Shown& each : shown) {
    panels.push_back({shown.size() == 1 ? problem.name : each.name, each.answer.posture.theta_r});
  }
  return figure(problem, panels);
}

/// The figure; empty if nothing can be drawn.
std::string drawn_figure(const Problem& problem, const PlotOptions& options,
                         const std::vector<Shown>& shown) {
  if (options.outline()) return outlines(problem, options, shown);
  const std::vector<std::string>& packages = options.source.packages;
  const nlohmann::ordered_json scene =
      scene_of(problem, read_visuals(problem.robot, {packages.begin(), packages.end()}), shown);
  if (scene["shown"].empty()) return "";
  return still_figure(scene, times_of(problem, options, shown.front().answer));
}

/// Rejects what the style or the task cannot show.
void require_drawable(const Problem& problem, const PlotOptions& options) {
  if (options.stills > 0 && !problem.motion) {
    throw std::invalid_argument(fmt::format("--stills: got {}, expected none: {} is a static task",
                                            options.stills, problem.name));
  }
  if (options.best && options.outline() && problem.motion) {
    throw std::invalid_argument(
        fmt::format("--style: got outline with --best for {}, expected shaded: outlines show one "
                    "trajectory",
                    problem.name));
  }
}

/// Returns status 1 without a figure if there is no such posture: showing another one would be
/// misleading. With --best the figure says so, and the status is that of the search.
int plot(const PlotOptions& options, const Problem& problem) {
  require_drawable(problem, options);
  std::vector<Shown> shown;
  shown.push_back({options.theta_r ? "given" : "default", evaluate_given(problem, options)});
  const Answer& given = shown.front().answer;
  const auto complain_of = [](const Answer& answer) {
    fmt::print(stderr, "{}: {}\n", to_string(answer.status), answer.reason.c_str());
    return int{kOtherStatus};
  };
  const bool exists = given.status != Status::kInvalidPosture;
  if (!exists && (!options.best || options.outline())) return complain_of(given);
  if (options.best) {
    shown.push_back({"best", solve_with_progress("plot", problem, options.read_options())});
  }
  const Answer& last = shown.back().answer;
  if (options.outline() && !last.has_posture()) return complain_of(last);
  const std::string svg = drawn_figure(problem, options, shown);
  if (svg.empty()) return complain_of(last);
  if (options.out.empty()) {
    fmt::print("{}", svg);
  } else {
    write_file(options.out, svg);
  }
  return options.best && !last.answered() ? complain_of(last) : int{kAnswered};
}

}  // namespace

void add_plot(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App& command = *app.add_subcommand(
      "plot", "draws a posture, beside the best one if asked, or stills of a trajectory, as SVG");
  options->add_case(command);
  add_theta_r(command, options->theta_r);
  command
      .add_option("--style", options->style,
                  "shaded: a three-quarter view of what `view` shows; outline: a posture from "
                  "above or the side with its wrench sets, a trajectory from two sides")
      ->capture_default_str()
      ->check(CLI::IsMember({"shaded", "outline"}));
  CLI::Option& best = *command.add_flag(
      "--best", options->best, "search as `solve` does, and draw what it finds beside the other");
  options->add_search(command);
  for (const char* name : {"--search", "--seed", "--budget"}) {
    command.get_option(name)->needs(&best);
  }
  command
      .add_option("--stills", options->stills,
                  "number of stills of a trajectory, evenly over time (default: start, middle or "
                  "peak, end)")
      ->check(CLI::Range(1, 8));
  options->source.add(command);
  options->motion.add(command);
  options->add_threads(command);
  command.add_option("--out", options->out, "SVG file to write (default: stdout)")
      ->check(reject_empty);
  command.callback([options, &exit_status] {
    const Problem problem =
        load_apart(options->choice.problem, options->source, options->motion,
                   {{"--theta-r", options->theta_r.value_or("")}}, {{"--out", options->out}});
    exit_status = plot(*options, problem);
  });
}

}  // namespace maxwrench
