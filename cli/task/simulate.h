#pragma once

#include <optional>
#include <string>

#include "cli/cli.h"
#include "cli/task/motion_options.h"
#include "maxwrench/tank.h"

namespace maxwrench {

struct SimulateOptions : CommonOptions {
  std::optional<std::string> theta_r, interpolation;
  std::string out, figure, integrator = "cvode";
  double planned = 0;  ///< zero: the capability, or what the trajectory is worth
  bool heaviest = false;
  MotionOptions motion;
  TankOptions tank;
  const CLI::App* command = nullptr;
};

/// Whether it held, what it missed, and how it ended.
void print_end(const TankRun& run);

/// The experiment of a task in time; returns the exit status.
int simulate_motion(const Problem& problem, const SimulateOptions& options);

}  // namespace maxwrench
