#pragma once

#include "maxwrench/types.h"

namespace maxwrench {

/// A camera without perspective: parallel lengths that are equal are equal on the picture, too.
struct Camera {
  /// Unit vectors of the world: to the right, up, and towards the viewer.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// A place or direction of the world as the camera sees it: x to the right, y up, z towards the
  /// viewer.
  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return axes.transpose() * x; }
};

/// A camera at `from`, seen from what it looks at. The world's z axis is up on the picture; for a
/// view along it the y axis is.
Camera camera_from(const Eigen::Vector3d& from);

}  // namespace maxwrench
