#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The support function of a convex set: for a unit direction d, the largest d'x over the set and a
/// point x where it is attained. Empty if the set is empty or unbounded in this direction.
using Support =
    std::function<std::optional<std::pair<double, Eigen::Vector2d>>(const Eigen::Vector2d& d)>;

/// The vertices of a convex set in the plane, counterclockwise, from its support function alone.
/// The result has one vertex for a point, two for a segment, and none if the support function
/// returns nothing in some direction.
///
/// The algorithm starts from the extreme points along the four axes. It then pushes every edge
/// between two neighbours outwards along its normal until the support exceeds the edge by less than
/// `tolerance` times the extent of the set. A polygon is found exactly, with one evaluation of the
/// support for each edge and each vertex. For a curved set the result is an inscribed polygon with
/// this tolerance.
std::vector<Eigen::Vector2d> polygon_from_support(const Support& support, double tolerance = 1e-9);

/// The vertices of the convex hull of some points, counterclockwise.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

}  // namespace maxwrench
