#pragma once

#include "lib/math/distance.h"

namespace maxwrench {

/// A convex body in its own axes: either the convex hull of `points`, or, if there are none, all
/// x + y with x in the box |x| <= half_sizes and y in the disc of `disc_radius` across z.
///
/// So a box, a segment along z (half_sizes (0, 0, l)), a point and a cylinder have no points.
struct ConvexCore {
  Eigen::Matrix<double, Eigen::Dynamic, 3> points = {};  ///< one in each row [m]
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero();  ///< [m]
  double disc_radius = 0;                                ///< [m]
};

/// Whether the cores have points nearer than `reach` >= 0 to each other, or intersect.
///
/// It is decided by bounds of the distance from both sides. If the distance differs from `reach`
/// by less than 1e-12 of the size of the cores, either answer may be returned.
bool closer_than(const ConvexCore& a, const Pose<double>& pose_a, const ConvexCore& b,
                 const Pose<double>& pose_b, double reach);

/// The closest points of two cores, in the frame of the poses. If they intersect, both points are
/// the same.
Between closest_points(const ConvexCore& a, const Pose<double>& pose_a, const ConvexCore& b,
                       const Pose<double>& pose_b);

/// A point of the core near x, up to rounding a mean of its points: closer to x than `reach` >= 0
/// if any is, but not always the closest. In the axes of the core.
Eigen::Vector3d point_near(const ConvexCore& core, const Eigen::Vector3d& x, double reach);

}  // namespace maxwrench
