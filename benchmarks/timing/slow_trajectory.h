#pragma once

#include "lib/math/random.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory_program.h"

namespace maxwrench {

/// A slow motion of `problem`, which must outlive it. Postures move straight from a random theta_r
/// a fifth of the way to another one, with static loads, and with the robot's effort rates over
/// `duration` [s].
TrajectoryProgram slow_trajectory(const Problem& problem, Wrench wrench, int instants,
                                  double duration, Random& random);

}  // namespace maxwrench
