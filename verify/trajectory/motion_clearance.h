#pragma once

#include "maxwrench/verification.h"
#include "verify/trajectory/effort_law.h"

namespace maxwrench {

/// [m] Bodies may be closer to each other than their margin by this. Good trajectories touch.
inline constexpr double kTouching = 1e-5;

/// Proves that no two bodies come closer than their margin less `kTouching` at any time.
///
/// Capsules and boxes are all points within a radius of a core, which is an inscribed box, so the
/// clearance of a pair is the distance of its cores less a constant. From the middle of a slice of
/// time to its ends it decreases no further than the points of both cores move relative to the last
/// link that carries both: |q_dot| times the distance from the joint to the farthest point, for
/// each joint between them. Slices are halved until this is small enough. Sets `clearance` and
/// `places` of the result. The distances at the middles are those of the robot's collision check.
MotionFault check_clearance(const TrajectoryModel& model, TrajectoryVerification& result);

}  // namespace maxwrench
