#pragma once

#include <optional>
#include <string>

#include "maxwrench/map.h"

namespace maxwrench {

/// The key of the radius of a ball of wrenches.
inline constexpr const char* kRadiusKey = "wrench.ball.radius";

/// The unit of a coordinate of a map that is a number of a list of scenarios: the radius of its
/// ball, or half the width of an interval (`uncertainty.trim`, `.mass.NAME`, `.volume.NAME` and
/// `.payload.mass`). Nothing: the coordinate is none of them.
std::optional<const char*> unit_of_list_key(const std::string& coordinate);

/// What the values of such a coordinate must be, in the words of an error message; nothing: the
/// task can have them all. The limits are finite and in order.
std::optional<std::string> fault_of_list_key(const Problem& task, const MapAxis& axis);

/// Gives a task another value of this key, in the unit of the key.
///
/// It is the task whose file has this value. The loads of an interval are linear in its width if
/// nothing else of the body is uncertain, so its cases are scaled.
void set_list_key(const std::string& key, double value, Problem& task);

}  // namespace maxwrench
