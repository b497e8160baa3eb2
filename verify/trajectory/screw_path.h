#pragma once

#include <optional>

#include "maxwrench/path.h"

namespace maxwrench {

/// The data of a path that rotates about an axis and translates; see `Path::screw`.
struct ScrewPath {
  Pose<double> start;  ///< the pose at t = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), centre = Eigen::Vector3d::Zero(),
                  displacement = Eigen::Vector3d::Zero();
  double angle = 0;
  Timing timing = Timing::kCubic;
};
std::optional<ScrewPath> screw_of(const Path& path);

}  // namespace maxwrench
