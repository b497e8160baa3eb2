#pragma once

#include <array>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// A mean of at most four of some points. The weights are positive; their sum need not be
/// exactly 1.
struct WeightedMean {
  std::array<std::size_t, 4> index{};
  std::array<double, 4> weight{};
  std::size_t size = 0;

  /// The mean, rounded.
  Eigen::Vector3d of(const std::vector<Eigen::Vector3d>& points) const;
};

struct NearestMeans {
  WeightedMean a, b;
};

/// Means of two lists of points, near the closest points of their convex hulls. A proof must check
/// what it needs of them.
NearestMeans nearest_means(const std::vector<Eigen::Vector3d>& a,
                           const std::vector<Eigen::Vector3d>& b);

}  // namespace maxwrench
