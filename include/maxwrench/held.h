#pragma once

#include <limits>
#include <string>

#include "maxwrench/solve.h"
#include "maxwrench/tank.h"

/// @file
/// Searches for the trajectory whose wrench the virtual tank holds best.

namespace maxwrench {

/// The options of `solve_held`.
struct HeldOptions {
  /// Largest number of experiments, never exceeded.
  long simulations = 200;
  std::string integrator = "cvode";  ///< the integrator of the experiments
  TankOptions tank;                  ///< options of the experiments
};

/// A trajectory and its experiment in the virtual tank.
///
/// The status is kBestFound, kBudgetExhausted after an interruption, with the best until then if
/// there is one, or kNoneFound if no experiment was held.
struct HeldTrajectory : Verdict {
  Answer answer;  ///< the trajectory, planned for the lag of the tank's thrusters
  TankRun run;    ///< its experiment
  /// The planned wrench of the experiment, as a share of the value of the trajectory.
  double share = std::numeric_limits<double>::quiet_NaN();
  /// The reading along c, of a path its least, of an impulse that at its peak [N, N m].
  double reading = std::numeric_limits<double>::quiet_NaN();
  /// The reading of the best of the first trajectories; NaN: none is held.
  double first = std::numeric_limits<double>::quiet_NaN();
  long simulations = 0;  ///< number of experiments
  std::string stopped;   ///< why the search ended
  double seconds = 0;    ///< wall time [s]
};

/// Searches for the trajectory of a task in time with the largest reading that the virtual tank
/// holds.
///
/// It is a search of two levels. The upper one moves the knots and the planned wrench, the lower
/// one finds efforts for them and runs the experiment:
///
///     max reading(knots, share)   subject to   the experiment is held (`TankSummary::held`).
///
/// The first trajectories are those that `solve_proven` finds with and without the lag of the
/// tank's thrusters, because the tank holds none whose joints are too fast between its instants. Of
/// a task that proofs do not support, they are those of `solve`. Of the better one the planned
/// wrench rises while the reading does. Then CMA-ES moves all knots, in the null space of the
/// equations that the scheme may have, and the planned wrench.
///
/// @param task     a task in time with one wrench along c
/// @param options  wrench, solver, search and budget of the first trajectories, seed and callbacks;
///                 the progress counts experiments
/// @param how      number of experiments, integrator and tank
/// @return the best trajectory found; the same at any number of threads
/// @throws std::invalid_argument if the task is not supported, or as `solve` and `check`.
HeldTrajectory solve_held(const Problem& task, const Options& options = {},
                          const HeldOptions& how = {});

/// Returns the result as text of several lines.
std::string summary(const HeldTrajectory& held);

/// Returns the result as a JSON object on one line: that of the answer, with `tank`.
std::string to_json(const HeldTrajectory& held);

}  // namespace maxwrench
