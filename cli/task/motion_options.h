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
  std::optional<double> thruster_lag;

  void add(CLI::App& app);
  /// Replaces settings of the task. Throws std::invalid_argument if an option does not apply.
  void change(Problem& problem) const;
};

/// Adds `--theta-r`, for any task. `without` says what it is by default.
void add_theta_r(CLI::App& app, std::optional<std::string>& theta_r,
                 const char* without = "those of the task");

/// The table that `--theta-r` gives: a file, or numbers that are used at all knots; without the
/// option, the constant default of the task.
Eigen::MatrixXd knots_of(const Problem& problem, const std::optional<std::string>& text);

/// The instants [s] of the postures to show: at the start, in the middle (for an impulse at its
/// peak) and at the end.
std::vector<double> telling_times(const MotionTask& task, const Trajectory& trajectory);

}  // namespace maxwrench
