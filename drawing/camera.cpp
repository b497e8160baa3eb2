#include "drawing/camera.h"

namespace maxwrench {

Camera camera_from(const Eigen::Vector3d& from) {
  const Eigen::Vector3d toward = from.normalized();
  Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(toward);
  right = right.norm() < 1e-9 ? Eigen::Vector3d::UnitX() : right.normalized();
  Camera camera;
  camera.axes << right, toward.cross(right), toward;
  return camera;
}

}  // namespace maxwrench
