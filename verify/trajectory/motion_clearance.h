#pragma once

#include "maxwrench/verification.h"
#include "verify/trajectory/effort_law.h"

namespace maxwrench {

/// [m] Bodies may be closer to each other than their margin by this. Good trajectories touch.
inline constexpr double kTouching = 1e-5;

/// Proves that no two bodies come closer than their margin less `kTouching` at any time.
///
/// The distance of two bodies at the middle of a slice decreases no further than the points of both
/// move until its ends, relative to the last link that carries both: |q_dot| times the distance
/// from the joint to the farthest point, of each joint between them. Slices are halved until this
/// is small enough. Sets `clearance` and `places` of the result. The distances themselves are those
/// of the robot's collision check.
MotionFault check_clearance(const TrajectoryModel& model, TrajectoryVerification& result);

}  // namespace maxwrench
