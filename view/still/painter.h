#pragma once

#include <vector>

#include "drawing/camera.h"
#include "drawing/face.h"
#include "view/still/solids.h"

namespace maxwrench {

/// Makes faces of solids, with the light from the upper left.
class Painter {
 public:
  explicit Painter(Camera camera) : camera_(std::move(camera)) {}

  /// Adds the faces of a solid that can be seen.
  void add(const Solid& solid, const Eigen::Affine3d& to_world, Rgb colour, double opacity = 1);
  /// Whether what is added from now on is seen faintly where others hide it.
  void shine_through(bool shines) { shines_ = shines; }
  /// Adds a line from a to b as a band that faces the viewer.
  void add_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double width, Rgb colour,
                double opacity = 1);

  const Camera& camera() const { return camera_; }
  const std::vector<Face>& faces() const { return faces_; }

 private:
  Camera camera_;
  bool shines_ = false;
  std::vector<Face> faces_;
};

/// The direction towards the light, as the camera sees it.
Eigen::Vector3d towards_light();

}  // namespace maxwrench
