#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/map.h"

namespace maxwrench {

/// The keys of numbers of the robot, its environment and its list of scenarios (`list_keys.h`) that
/// a coordinate of a map can be, beside the masses of bodies (`links.NAME.mass`) and the widths of
/// intervals (`uncertainty.KEY`).
const std::vector<std::string>& robot_keys();

/// The unit of such a key, mass or width. Nothing: the coordinate is none of them.
std::optional<const char*> unit_of_robot_key(const std::string& coordinate);

/// What the values of such a coordinate must be, in the words of an error message; nothing: the
/// task can have them all. The limits are finite and in order.
std::optional<std::string> fault_of_robot_key(const Problem& task, const MapAxis& axis);

/// Gives a task another value of this key, in the unit of the key.
///
/// It is the task whose files have this value: loads of uncertain volumes change with the density.
/// A current makes a list of a task that has none, so pose, wrench and limits are set before.
void set_robot_key(const std::string& key, double value, Problem& task);

}  // namespace maxwrench
