#include "drawing/face.h"

#include <cmath>

namespace maxwrench {
namespace {

constexpr double kLineShade = 0.55;  ///< of black in the colour of a face's lines

/// A darker one, of few bits: it has few characters in a file.
Rgb line_colour(Rgb colour) {
  const Rgb high = mixed(colour, 0x000000, kLineShade) >> 4U & 0x0F0F0FU;
  return high << 4U | high;
}

}  // namespace

Rgb mixed(Rgb a, Rgb b, double share) {
  Rgb result = 0;
  for (const unsigned shift : {16U, 8U, 0U}) {
    const double from = a >> shift & 0xFFU, to = b >> shift & 0xFFU;
    result |= static_cast<Rgb>(std::lround(from + share * (to - from))) << shift;
  }
  return result;
}

std::vector<Eigen::Vector2d> outline_of(const Face& face) {
  std::vector<Eigen::Vector2d> outline;
  outline.reserve(face.corners.size());
  for (const Eigen::Vector3d& corner : face.corners) outline.emplace_back(corner.head<2>());
  return outline;
}

void draw_faces(Svg& svg, const Viewport& to_px, const std::vector<Face>& faces) {
  svg.begin_surfaces();
  for (const Face& face : faces) {
    const std::vector<Eigen::Vector2d> outline = to_px(outline_of(face));
    svg.surface(outline, face.colour, face.opacity);
    for (std::size_t i = 0; i < face.lines.size(); ++i) {
      if (!face.lines[i]) continue;
      // Neighbouring edges are one line.
      std::vector<Eigen::Vector2d> line = {outline[i]};
      for (; i < face.lines.size() && face.lines[i]; ++i) {
        line.push_back(outline[(i + 1) % outline.size()]);
      }
      svg.surface_line(line, line_colour(face.colour));
    }
  }
  svg.end_surfaces();
}

}  // namespace maxwrench
