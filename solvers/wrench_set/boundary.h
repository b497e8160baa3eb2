#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace maxwrench {

/// A half space normal'y <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset = 0;
};

/// The faces of a polytope.
struct Boundary {
  std::vector<int> vertices;            ///< the vertices, as indices of points
  std::vector<int> facets;              ///< the facets, as indices of half spaces
  std::vector<std::vector<int>> faces;  ///< vertices of each facet, as indices of `vertices`
};

/// The faces of a polytope of q = 1, 2 or 3 dimensions, from points that include all vertices and
/// half spaces that include all facets. Each point is in all half spaces and each half space
/// touches the polytope, to the tolerance. Components of points and normals beyond q are zero.
///
/// A point lies on the half spaces that it is within the tolerance of. It is a vertex if no other
/// point lies on all of these and more; of points that lie on the same ones, the first is the
/// vertex. A half space is a facet by the same rule. The faces are in the order of
/// `WrenchSet::faces`. None: they do not close.
std::optional<Boundary> boundary_of(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<HalfSpace>& half_spaces, int q,
                                    double tolerance);

}  // namespace maxwrench
