#pragma once

#include <optional>
#include <string>

#include "cli/cli.h"
#include "cli/task/dies_option.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "maxwrench/tank.h"

namespace maxwrench {

struct ScenarioExperiments;

struct SimulateOptions : CommonOptions {
  std::optional<std::string> theta_r, interpolation;
  std::string out, figure, integrator = "cvode";
  double planned = 0;  ///< 0: the capability, or the value of the trajectory
  bool heaviest = false;
  MotionOptions motion;
  ProblemOptions source;
  TankOptions tank;
  DiesOption dies;
  const CLI::App* command = nullptr;
};

/// Prints whether it was held, which conditions it missed, and how it ended.
void print_end(const TankRun& run);

/// Writes and prints the experiments of a list of scenarios; returns the exit status.
int report_experiments(const Problem& problem, const SimulateOptions& options,
                       const ScenarioExperiments& experiments);

/// Runs the experiment of a task in time; returns the exit status.
int simulate_motion(const Problem& problem, const SimulateOptions& options);

}  // namespace maxwrench
