#pragma once

#include <Eigen/Dense>
#include <vector>

namespace maxwrench {

/// A facet of a convex hull: normal'x = offset, with normal'x <= offset for all points.
struct HullFacet {
  Eigen::VectorXd normal;     ///< outward unit normal (d)
  std::vector<int> vertices;  ///< indices of its vertices, in no order
};

/// The convex hull of points.
struct Hull {
  std::vector<int> vertices;  ///< indices of its vertices; empty if Qhull finds no volume
  std::vector<HullFacet> facets;
};

/// The convex hull of n points in d dimensions, d >= 2, by Qhull. Facets that rounding cannot tell
/// from one plane are one facet.
///
/// @param points  the points (d×n)
Hull quick_hull(const Eigen::MatrixXd& points);

}  // namespace maxwrench
