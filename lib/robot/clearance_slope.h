#pragma once

#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

/// The derivative of a clearance by the position of a joint: by the velocities of the two nearest
/// points, which differ, along the line between them. `links`: pose of each relative to the base.
double clearance_slope(const Robot& robot, const std::vector<Pose<double>>& links,
                       const ClosestPoints& near, int joint);

}  // namespace maxwrench
