#pragma once

#include <string>
#include <utility>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// The pairs of bodies that `Collision::find_ignored` leaves out, besides those that are ignored
/// already. Adds a note to the robot for each reason, with its pairs.
///
/// Bodies touch where they are closer than the margin and 1e-6 m. A body's link is connected to the
/// nearest link before it that has shapes. `robot` needs its links and joints.
std::vector<std::pair<std::string, std::string>> touching_bodies(
    Robot& robot, const std::vector<Shape>& shapes,
    const std::vector<std::pair<std::string, std::string>>& ignored, double margin);

}  // namespace maxwrench
