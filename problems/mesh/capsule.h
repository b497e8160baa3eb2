#pragma once

#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// A capsule that contains the points, at least one, with a small volume. Its axis starts from the
/// principal axes of the points and from those of their frame, and is then turned as long as the
/// volume falls. The other members of the shape keep their default values.
Shape capsule_around(const std::vector<Eigen::Vector3d>& points);

}  // namespace maxwrench
