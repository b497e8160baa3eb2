#pragma once

#include <memory>

#include "maxwrench/task.h"

namespace maxwrench {

/// A capsule, cylinder or box that contains every point within a margin of another one.
class GrownShape {
 public:
  virtual ~GrownShape() = default;
  /// Whether it intersects another grown shape.
  virtual bool intersects(const Pose<double>& pose, const GrownShape& other,
                          const Pose<double>& other_pose) const = 0;
};

/// Makes a grown shape of a shape that is no hull.
///
/// FCL tests whether grown shapes intersect. In WebAssembly, for which there is no FCL, GJK does.
std::shared_ptr<const GrownShape> make_grown_shape(const Shape& shape, double margin);

}  // namespace maxwrench
