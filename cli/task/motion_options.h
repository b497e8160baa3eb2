#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

struct Trajectory;

/// Options of tasks in time.
struct MotionOptions {
  std::optional<std::string> scheme, t_h;

  void add(CLI::App& app);
  /// Replaces what the task says. Throws std::invalid_argument where that means nothing.
  void change(Problem& problem) const;
};

/// `--theta-r`, of any task.
void add_theta_r(CLI::App& app, std::optional<std::string>& theta_r);

/// The table that `--theta-r` names: a file, or numbers that hold throughout; without it the
/// constant default of the task.
Eigen::MatrixXd knots_of(const Problem& problem, const std::optional<std::string>& text);

/// When postures tell most [s]: at the start, in the middle (of an impulse at its peak) and at the
/// end.
std::vector<double> telling_times(const MotionTask& task, const Trajectory& trajectory);

}  // namespace maxwrench
