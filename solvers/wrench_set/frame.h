#pragma once

#include <optional>
#include <vector>

#include "solvers/wrench_set/support.h"

namespace maxwrench {

/// Coordinates y (q) of the affine hull of a wrench set, f = origin + edges y, in which the set has
/// a size of about 1 along each direction.
struct AffineFrame {
  Eigen::VectorXd origin;  ///< a point of the set (k)
  Eigen::MatrixXd edges;  ///< edges of a simplex in the set (k×q); for q = k > 1 and k = q + 1 = 3
                          ///< they are a right-handed frame, in the second case with `normals`
  Eigen::MatrixXd to_frame;  ///< pseudo-inverse of the edges (q×k)
  Eigen::MatrixXd normals;   ///< orthonormal directions in which the set is flat (k×(k - q))

  int dimension() const { return static_cast<int>(edges.cols()); }  ///< q
  /// The coordinates of a point, padded with zeros.
  Eigen::Vector3d coordinates(const Eigen::VectorXd& f) const;
};

/// Finds the affine hull of a set from its support. The first two points of the simplex are the
/// ends of the set along the axis of its largest extent. Each other one is the farthest from the
/// hull of those before, of the points found in the directions orthogonal to it.
///
/// @param support  the set
/// @param k        number of coordinates of the set
/// @param points   receives all points found
/// @return none if the support has no value in some direction
std::optional<AffineFrame> find_frame(WrenchSupport& support, Eigen::Index k,
                                      std::vector<SupportPoint>& points);

}  // namespace maxwrench
