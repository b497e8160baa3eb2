#pragma once

#include "maxwrench/solve.h"

namespace maxwrench {

/// Computes what each scenario of a task in time allows at each instant alone.
///
/// It is the optimum of the program of the instant, with the limits and the wrench of the scenario
/// and the forces of the motion. Limits of effort rates join instants and do not count, so the
/// value of the trajectory may be less than the least of these numbers.
///
/// @param answer  of a task in time with a list of scenarios, with a valid trajectory
/// @return values (S×N) [unit] of the scenarios in the order of `scenario_ends`, and of the last N
///         instants of the trajectory (the start of an impulse may be missing). NaN: no efforts
///         balance the motion, or there is no verdict; infinite: there is no end, or the instant
///         has no objective, as with a wrench that is only held
/// @throws std::invalid_argument if the task is no such task or there is no valid trajectory.
Eigen::MatrixXd scenario_values(const Answer& answer);

}  // namespace maxwrench
