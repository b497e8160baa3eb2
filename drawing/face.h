#pragma once

#include <cstdint>
#include <vector>

#include "drawing/svg.h"

namespace maxwrench {

/// Red, green and blue, 0xRRGGBB.
using Rgb = std::uint32_t;

/// A mix of two colours: `share` of the second.
Rgb mixed(Rgb a, Rgb b, double share);

/// A flat convex part of a surface as a camera sees it: x to the right, y up, z towards the viewer
/// [m].
struct Face {
  std::vector<Eigen::Vector3d> corners;  ///< in order around the face
  Rgb colour = 0;
  double opacity = 1;
  bool shines_through = false;  ///< whether it is seen faintly where others hide it
  /// Whether the edge from corner i to the next one is drawn as a line. Empty: none is.
  std::vector<bool> lines = {};
};

/// The corners without their depth.
std::vector<Eigen::Vector2d> outline_of(const Face& face);

/// Draws faces, the farthest first, as `depth_order` returns them.
void draw_faces(Svg& svg, const Viewport& to_px, const std::vector<Face>& faces);

}  // namespace maxwrench
