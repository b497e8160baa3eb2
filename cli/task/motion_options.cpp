#include "cli/task/motion_options.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <stdexcept>

#include "cli/cli.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "problems/make/motion_task.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

[[noreturn]] void throw_bad_option(const char* option, const std::string& got,
                                   const std::string& expected) {
  throw std::invalid_argument(fmt::format("{}: got '{}', expected {}", option, got, expected));
}

void change_peak(const Problem& problem, const std::string& text, MotionTask& task) {
  if (!task.impulse) {
    throw_bad_option("--t-h", text, fmt::format("none for a {}: it has no peak", problem.type()));
  }
  int knot = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, knot);
  const bool whole = read.ec == std::errc() && read.ptr == end;
  if (text != "best" && !(whole && knot >= 1 && knot <= task.k)) {
    throw_bad_option("--t-h", text, fmt::format("a knot from 1 to k = {}, or best", task.k));
  }
  task.t_h = knot;
}

void change_lag(double lag, MotionTask& task) {
  if (!(lag >= 0 && lag <= kLongestLag)) {
    throw_bad_option("--thruster-lag", fmt::format("{}", lag), lag_range());
  }
  task.thruster_lag = lag;
}

/// Whether the text begins like a number, and is not the name of a file.
bool is_number(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+-.");
  return text.empty() || text.find(',') != std::string::npos ||
         (first != std::string::npos && text.find_first_not_of("0123456789.+-eE") > text.size());
}

}  // namespace

void MotionOptions::add(CLI::App& app) {
  app.add_option("--scheme", scheme, "scheme that turns knots into motion (tasks in time)");
  app.add_option("--t-h", t_h, "knot of an impulse's peak, or best");
  app.add_option("--thruster-lag", thruster_lag,
                 "time constant of the thrusters whose commands the trajectory keeps within the "
                 "limits [s] (tasks in time)");
}

void MotionOptions::change(Problem& problem) const {
  if (problem.motion) {
    if (scheme) set_scheme("--scheme", *scheme, problem);
    if (t_h) change_peak(problem, *t_h, *problem.motion);
    if (thruster_lag) change_lag(*thruster_lag, *problem.motion);
    return;
  }
  const std::string expected = fmt::format("none: {} is a static task", problem.name);
  if (scheme) throw_bad_option("--scheme", *scheme, expected);
  if (t_h) throw_bad_option("--t-h", *t_h, expected);
  if (thruster_lag) throw_bad_option("--thruster-lag", fmt::format("{}", *thruster_lag), expected);
}

void add_theta_r(CLI::App& app, std::optional<std::string>& theta_r, const char* without) {
  app.add_option("--theta-r", theta_r,
                 fmt::format("redundant coordinates, separated by commas (default: {}); for a task "
                             "in time, a constant posture or a CSV file with a row for each knot",
                             without));
}

Eigen::MatrixXd knots_of(const Problem& problem, const std::optional<std::string>& text) {
  std::error_code ignored;
  const bool numbers = text && !std::filesystem::exists(*text, ignored) && is_number(*text);
  if (text && !numbers) return load_knots(*text, problem);
  if (!text) return default_knots(problem);
  const Eigen::VectorXd theta_r = theta_r_of(problem, text);
  if (theta_r.size() != problem.redundancy()) {
    throw_bad_option(
        "--theta-r", *text,
        fmt::format("{} numbers or a file of {}{} rows", problem.redundancy(),
                    problem.motion->transfer ? "k - 2 = " : "k = ", knots_of(problem)));
  }
  return constant_knots(problem, theta_r);
}

std::vector<double> telling_times(const MotionTask& task, const Trajectory& trajectory) {
  const int t_h = task.t_h > 0 ? task.t_h : trajectory.t_h;
  const double middle = task.impulse && t_h > 0 ? task.T * t_h / task.k : task.T / 2;
  return {0, middle, task.T};
}

}  // namespace maxwrench
