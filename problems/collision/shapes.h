#pragma once

#include "lib/math/gjk.h"
#include "maxwrench/task.h"

namespace maxwrench {

inline bool is(const Shape& shape, Shape::Kind kind) { return shape.kind == kind; }

/// The distance of the farthest point of the shape from its origin.
double bounding_radius(const Shape& shape);

/// Moves the origin of a hull to the centre of its points, so that its bounding sphere is small.
void centre_hull(Shape& shape);

/// The shape as GJK knows it: all points within `rounding` of a core.
struct RoundedCore {
  ConvexCore core;
  double rounding = 0;
};

RoundedCore rounded_core(const Shape& shape);

/// Sets `core` to a box or a hull such that the shape contains all points within a radius of it,
/// and returns this radius. But for a cylinder these points are the whole shape.
double inner_core(const Shape& shape, InnerBody& core);

/// The shape as a convex body. A cylinder becomes a prism of 32 faces.
ConvexBody to_convex_body(const Shape& shape);

}  // namespace maxwrench
