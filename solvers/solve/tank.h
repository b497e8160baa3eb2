#pragma once

#include <string>
#include <vector>

#include "maxwrench/tank.h"

namespace maxwrench {

struct Answer;
struct TrajectorySolverEntry;
struct Problem;

/// The names of the integrators that serve the virtual tank on a problem; none if there is no
/// experiment, as with a second contact or a measure that is no wrench of the polytope.
std::vector<std::string> served_integrators(const Problem& problem, const std::string& measure);

/// The simulated experiment at the posture of a static task with the wrench and the efforts of its
/// capability; `planned`: c'h instead of the capability's own [N, N m].
TankRun simulate_posture(const Answer& answer, double planned, const std::string& integrator,
                         const TankOptions& options);

/// The same with a mass of `load` kg instead of a load cell. Throws std::invalid_argument unless c
/// is the force upwards.
TankRun simulate_load(const Answer& answer, double load, const std::string& integrator,
                      TankOptions options);

/// The heaviest whole number of kilograms that an end effector that nothing else holds carries for
/// the whole hold at the posture, by bisection between nothing and one more than the capability.
int heaviest_load(const Answer& answer, const std::string& integrator, TankOptions options);

/// What the tank was asked for along a trajectory, and what came of it.
struct TrajectoryExperiment {
  TankScript script;
  TankRun run;  ///< without samples and with the script's status if there is nothing to ask for
};

/// The simulated experiment along a trajectory that was evaluated, on the spline as well.
TrajectoryExperiment simulate_trajectory(const Problem& problem, const Trajectory& trajectory,
                                         Wrench wrench, const TrajectorySolverEntry& lp,
                                         const ScriptOptions& script, const std::string& integrator,
                                         const TankOptions& options);

/// What joins the instants of a task's scheme unless another is asked for.
Interpolation usual_interpolation(const Problem& problem);

/// The samples as CSV: t, planned, c'h_e, the wrench, the efforts, and how well it went; of
/// a task in time also theta_r and the angle of the end effector, and the wrench in axes that turn
/// with the cell.
std::string tank_csv(const Problem& problem, const TankRun& run);

}  // namespace maxwrench
