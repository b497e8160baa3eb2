#pragma once

#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

/// The derivative of a clearance with respect to the position of a joint: the relative velocity of
/// the two closest points, which must differ, along the line between them. `links`: the pose of
/// each link relative to the base.
double clearance_slope(const Robot& robot, const std::vector<Pose<double>>& links,
                       const ClosestPoints& near, int joint);

}  // namespace maxwrench
