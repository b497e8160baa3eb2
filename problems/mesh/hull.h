#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The number of vertices that a hull keeps, so that its collision checks stay fast.
inline constexpr int kMostHullVertices = 64;

/// A convex body that contains given points: all points within `radius` of the hull of `points`.
struct GrownHull {
  std::vector<Eigen::Vector3d> points;  ///< some of the given points, at least four [m]
  double radius = 0;                    ///< 0 if `points` has all vertices of the hull [m]
  int vertices = 0;                     ///< vertices of the hull of all given points
};

/// The convex hull of points, at least one, by Qhull.
///
/// If it has more than `most` vertices (at least four), it keeps that many: one after the other the
/// vertex that is farthest from the hull of those before. The radius is the distance of the
/// farthest vertex that is left out, so the body contains all points. Points in a plane or on a
/// line are no exception. If there are fewer than four vertices, the last one is repeated.
GrownHull hull_of(const std::vector<Eigen::Vector3d>& points, int most = kMostHullVertices);

}  // namespace maxwrench
