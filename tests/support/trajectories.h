#pragma once

#include "lib/math/random.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory_program.h"

// Programs of trajectories, for tests and benchmarks.

namespace maxwrench {

/// What a random trajectory program is made of.
struct TrajectoryRecipe {
  int instants = 3;
  Wrench wrench = Wrench::kPure;
  bool rates = true;
  int peak = -1;
  double rho = kInfinity;
  int border = 0;     ///< p
  double load = 0.1;  ///< standard deviation of what is added to tau_d, as a share of u_max
  double du = 0.3;    ///< most of u_max per step, of rated actuators
};

/// Instants at random postures of `problem` (which outlives it), tau_d perturbed.
TrajectoryProgram random_trajectory(const Problem& problem, const TrajectoryRecipe& recipe,
                                    Random& random);

}  // namespace maxwrench
