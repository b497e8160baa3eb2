#pragma once

#include <algorithm>

#include "maxwrench/robot.h"

namespace maxwrench {

/// [N] Along a free axis, a brake of a parked base exerts any force up to this one, and 1 m beside
/// it the torque. No arm loads it as much.
inline constexpr double kBrakeForce = 1e5;

/// Whether brakes hold the base: as many forces as it has free axes, each larger than any load.
inline bool is_parked(const Robot& robot) {
  return robot.thrusters.size() == robot.base_axes.size() &&
         std::all_of(robot.thrusters.begin(), robot.thrusters.end(), [](const Thruster& each) {
           return each.force_min <= -kBrakeForce && each.force_max >= kBrakeForce;
         });
}

}  // namespace maxwrench
