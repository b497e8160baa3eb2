#include "cli/motion_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <stdexcept>

#include "cli/cli.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

[[noreturn]] void refuse_option(const char* option, const std::string& got,
                                const std::string& expected) {
  throw std::invalid_argument(fmt::format("{}: got '{}', expected {}", option, got, expected));
}

void change_scheme(const Problem& problem, const std::string& name, MotionTask& task) {
  const std::vector<std::string> served = scheme_names(task.impulse);
  if (std::find(served.begin(), served.end(), name) == served.end()) {
    refuse_option("--scheme", name,
                  fmt::format("one of {} for {} {}", fmt::join(served, " "),
                              task.impulse ? "an" : "a", problem.type()));
  }
  task.scheme = parse_scheme(name);
  if (task.scheme == Scheme::kSpline && task.k < 2) {
    refuse_option("--scheme", name, "another one for k = 1");
  }
}

void change_peak(const Problem& problem, const std::string& text, MotionTask& task) {
  if (!task.impulse) {
    refuse_option("--t-h", text, fmt::format("none for a {}: it has no peak", problem.type()));
  }
  int knot = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, knot);
  const bool whole = read.ec == std::errc() && read.ptr == end;
  if (text != "best" && !(whole && knot >= 1 && knot <= task.k)) {
    refuse_option("--t-h", text, fmt::format("a knot of 1 to k = {}, or best", task.k));
  }
  task.t_h = knot;
}

/// Whether the text begins as a number does, and no name of a file.
bool is_number(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+-.");
  return text.empty() || text.find(',') != std::string::npos ||
         (first != std::string::npos && text.find_first_not_of("0123456789.+-eE") > text.size());
}

}  // namespace

void MotionOptions::add(CLI::App& app) {
  app.add_option("--scheme", scheme, "how knots become motion, of a task in time");
  app.add_option("--t-h", t_h, "the knot of a heave's peak, or best");
}

void MotionOptions::change(Problem& problem) const {
  if (problem.motion) {
    if (scheme) change_scheme(problem, *scheme, *problem.motion);
    if (t_h) change_peak(problem, *t_h, *problem.motion);
    return;
  }
  const std::string expected = fmt::format("none: {} is a static task", problem.name);
  if (scheme) refuse_option("--scheme", *scheme, expected);
  if (t_h) refuse_option("--t-h", *t_h, expected);
}

Eigen::MatrixXd knots_of(const Problem& problem, const std::optional<std::string>& text) {
  std::error_code ignored;
  const bool numbers = text && !std::filesystem::exists(*text, ignored) && is_number(*text);
  if (text && !numbers) return load_knots(*text, problem);
  const Eigen::VectorXd theta_r = theta_r_of(problem, text);
  if (theta_r.size() != problem.redundancy()) {
    refuse_option("--theta-r", *text,
                  fmt::format("{} numbers or a file of k = {} rows", problem.redundancy(),
                              problem.motion->k));
  }
  return theta_r.transpose().replicate(problem.motion->k, 1);
}

}  // namespace maxwrench
