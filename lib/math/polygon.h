#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The largest d'x over a convex set for a unit direction d, and a point x where it is attained;
/// nothing if the set is empty or has no end in this direction.
using Support =
    std::function<std::optional<std::pair<double, Eigen::Vector2d>>(const Eigen::Vector2d& d)>;

/// The vertices of a convex set in the plane, counterclockwise, from its support alone; one vertex
/// for a point, two for a segment, none if the support has no answer in some direction.
///
/// The extreme points along the four axes come first; then every edge between two neighbours is
/// pushed outwards along its normal until the support exceeds it by less than `tolerance` times the
/// extent of the set. A polygon is found exactly, with one question for each edge and each vertex;
/// a curved set is inscribed to that tolerance.
std::vector<Eigen::Vector2d> polygon_from_support(const Support& support, double tolerance = 1e-9);

/// The vertices of the convex hull of some points, counterclockwise.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

}  // namespace maxwrench
