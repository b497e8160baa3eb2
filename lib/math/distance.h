#pragma once

#include "maxwrench/types.h"

namespace maxwrench {

/// The two closest points of two shapes.
struct Between {
  Eigen::Vector3d on_a, on_b;
  double distance() const { return (on_a - on_b).norm(); }
};

/// The closest points x and y of the segments [a0, a1] and [b0, b1].
Between segment_to_segment(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                           const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);
inline double segment_distance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                               const Eigen::Vector3d& b0, const Eigen::Vector3d& b1) {
  return segment_to_segment(a0, a1, b0, b1).distance();
}

/// The closest points of the segment [p0, p1] and the box |x| <= half_sizes. If they intersect,
/// both points are the same.
Between segment_to_box(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                       const Eigen::Vector3d& half_sizes);
inline double segment_box_distance(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                                   const Eigen::Vector3d& half_sizes) {
  return segment_to_box(p0, p1, half_sizes).distance();
}

}  // namespace maxwrench
