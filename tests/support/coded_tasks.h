#pragma once

#include <limits>
#include <stdexcept>
#include <string>

#include "maxwrench/task.h"

// Robots and tasks that are built in code as the shipped files describe them.

namespace maxwrench {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A rotation about z.
Pose<double> yaw_turn(double yaw);
/// A unit wrench.
Vector6d along(int axis);
/// A capsule from the link's origin to (0.1, 0, 0): its axis, z, along the link's x.
Shape capsule(int link);
/// problems/planar/vehicle.toml and .urdf, number by number.
Robot vehicle();
Collision vehicle_shapes();
/// problems/planar/force.toml, with this robot or the vehicle.
TaskSpec push(const Robot& robot);
TaskSpec push();
/// The second contact of problems/planar/two_arms.toml, and the task.
ContactSpec wall();
TaskSpec push_on_wall();
/// problems/planar/trajectory.toml.
TaskSpec push_on_the_way();
/// problems/uvms/valve.toml.
TaskSpec valve();
/// The names of the limits of a list of scenarios.
std::vector<std::string> limit_names(const ScenarioList& list);
/// problems/uvms/valve_impulse.toml.
TaskSpec impulse();

/// The message with which a call is rejected.
template <class Function>
std::string rejection_of(const Function& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace maxwrench
