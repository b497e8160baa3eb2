#pragma once

#include "lib/math/quick_hull.h"

namespace maxwrench {

/// The convex hull of n points in two or three dimensions by gift wrapping (Chand and Kapur 1970):
/// from a facet over each of its edges to the next. Points within 1e-10 of the size of the set of a
/// plane are on it.
///
/// It takes the place of `quick_hull` in the engine of pages, for which there is no Qhull. Its cost
/// is the number of edges times n, which is little for the sets of wrenches.
///
/// @param points  the points (2×n or 3×n)
/// @return the hull; empty if the points have no volume, or rounding hides how facets meet
Hull wrapped_hull(const Eigen::MatrixXd& points);

}  // namespace maxwrench
