#pragma once

#include "maxwrench/map.h"

namespace maxwrench {

/// The largest number of times that intervals of the grid of a map are halved.
inline constexpr int kMostHalvings = 10;

/// Throws std::invalid_argument, with one line, unless the plan can be carried out for the task.
void check_plan(const Problem& task, const MapPlan& plan);

/// Whether a coordinate is one of `map_coordinates`, or the mass of a body.
bool is_map_coordinate(const std::string& name);

/// The actuators whose limits a coordinate multiplies: indices in u. Empty: it is another
/// coordinate, or there are none.
std::vector<Eigen::Index> scaled_actuators(const Robot& robot, const std::string& coordinate);

/// Throws std::invalid_argument, as `certify`, unless the cells have bounds with a measure and
/// wrench.
void require_bound(const Problem& task, const MapPlan& plan, const Case& choice);

/// The coordinates without effect: in the middle of the others, no sampled posture has another
/// value or status at another value of the coordinate.
std::vector<std::string> find_unchanging(const Problem& task, const MapPlan& plan,
                                         const Options& options);

}  // namespace maxwrench
