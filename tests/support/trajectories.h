#pragma once

#include "lib/math/random.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory_program.h"

// Programs of trajectories, for tests and benchmarks.

namespace maxwrench {

/// The parameters of a random trajectory program.
struct TrajectoryRecipe {
  int instants = 3;
  Wrench wrench = Wrench::kPure;
  bool rates = true;
  int peak = -1;
  double rho = kInfinity;
  int border = 0;       ///< p
  bool common = false;  ///< one factor for all instants
  double load = 0.1;    ///< standard deviation of the numbers added to tau_d, as a share of u_max
  double du = 0.3;      ///< largest change per step of rated actuators, as a share of u_max
};

/// Instants at random postures of `problem` (which must outlive it), with perturbed tau_d.
TrajectoryProgram random_trajectory(const Problem& problem, const TrajectoryRecipe& recipe,
                                    Random& random);

}  // namespace maxwrench
