#pragma once

#include <string>
#include <vector>

#include "maxwrench/tank.h"

namespace maxwrench {

struct Answer;
struct Capability;
struct TrajectorySolverEntry;
struct Problem;

/// The names of the integrators that the virtual tank supports for a problem. Empty if there is no
/// experiment, as with a second contact, a robot that the tank does not model or with a measure
/// that is not a wrench of the polytope.
std::vector<std::string> supported_integrators(const Problem& problem, const std::string& measure);

/// The reading that counts: the mean of a hold, the lowest along a path, that at the peak of an
/// impulse.
double reading_of(const TankSummary& summary);

/// The actuator of this name, which dies at t [s].
///
/// @throws std::invalid_argument, in one line that begins with `key`, if there is none.
ActuatorDeath death_of(const Robot& robot, const std::string& key, const std::string& name,
                       double t);

/// The wrench of an experiment with a planned c'h [N, N m]: that of a capability, smaller as a
/// whole, or larger along c.
TargetWrench target_wrench(const Problem& problem, const Capability& capability, double planned,
                           Wrench wrench);

/// The simulated experiment at the posture of a static task, with the wrench and the efforts of its
/// capability. `planned` is the planned c'h, in place of the capability's own [N, N m].
TankRun simulate_posture(const Answer& answer, double planned, const std::string& integrator,
                         const TankOptions& options);

/// The same with a mass of `load` kg in place of a load cell. Throws std::invalid_argument unless c
/// is the upward force.
TankRun simulate_load(const Answer& answer, double load, const std::string& integrator,
                      TankOptions options);

/// A load in whole kilograms. The status is kBestFound, or kBudgetExhausted after an interruption.
struct HeaviestLoad : Verdict {
  int mass = 0;  ///< the largest mass that was seen to be carried [kg]
};

/// The largest whole number of kilograms that an otherwise free end effector carries for the whole
/// hold at the posture. Found by bisection between zero and one more than the capability.
HeaviestLoad heaviest_load(const Answer& answer, const std::string& integrator,
                           TankOptions options);

/// The planned experiment along a trajectory, and its result.
struct TrajectoryExperiment {
  TankScript script;
  TankRun run;  ///< without samples and with the script's status if there is nothing to run
};

/// The simulated experiment along a trajectory, which must be evaluated at its instants and also
/// between knots, on the spline.
TrajectoryExperiment simulate_trajectory(const Problem& problem, const Trajectory& trajectory,
                                         Wrench wrench, const TrajectorySolverEntry& lp,
                                         const ScriptOptions& script, const std::string& integrator,
                                         const TankOptions& options);

/// The default interpolation between the instants of a task's scheme.
Interpolation usual_interpolation(const Problem& problem);

/// The samples as CSV: t, planned c'h, c'h_e, the wrench, the efforts, and the errors. For a task
/// in time also theta_r and the angle of the end effector; its wrench is in axes that turn with the
/// cell.
std::string tank_csv(const Problem& problem, const TankRun& run);

}  // namespace maxwrench
