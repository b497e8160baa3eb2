#include "view/still/painter.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace maxwrench {
namespace {

constexpr double kCrease = 0.6;  ///< rad: sharper edges are lines
// Shares of a colour in the shade, from the light, and from the viewer's side.
constexpr double kAmbient = 0.66, kDiffuse = 0.42, kFront = 0.06;

Eigen::Vector3d normal_of(const std::vector<Eigen::Vector3d>& points,
                          const std::vector<int>& face) {
  const auto at = [&](std::size_t i) -> const Eigen::Vector3d& {
    return points[static_cast<std::size_t>(face[i % face.size()])];
  };
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    normal += (at(i) - at(0)).cross(at(i + 1) - at(0));
  }
  return normal.normalized();
}

Rgb lit(Rgb colour, const Eigen::Vector3d& normal) {
  const double light = kAmbient + kDiffuse * std::max(0.0, normal.dot(towards_light())) +
                       kFront * std::max(0.0, normal.z());
  return light > 1 ? mixed(colour, 0xFFFFFF, std::min(2.2 * (light - 1), 1.0))
                   : mixed(0x000000, colour, light);
}

using EdgeKey = std::pair<int, int>;

EdgeKey edge_of(const std::vector<int>& face, std::size_t i) {
  const int a = face[i], b = face[(i + 1) % face.size()];
  return {std::min(a, b), std::max(a, b)};
}

/// Whether an edge is drawn as a line: it ends the surface, or the part of it that is seen, or is
/// sharp.
bool is_line(const std::vector<Eigen::Vector3d>& normals, const std::vector<std::size_t>& beside,
             bool sharp_ones) {
  if (beside.size() != 2) return beside.size() == 1;
  const Eigen::Vector3d &a = normals[beside[0]], &b = normals[beside[1]];
  if ((a.z() > 0) != (b.z() > 0)) return true;
  return sharp_ones && a.dot(b) < std::cos(kCrease);
}

}  // namespace

Eigen::Vector3d towards_light() { return Eigen::Vector3d(-0.5, 0.75, 0.45).normalized(); }

void Painter::add(const Solid& solid, const Eigen::Affine3d& to_world, Rgb colour, double opacity) {
  std::vector<Eigen::Vector3d> points, normals;
  for (const Eigen::Vector3d& x : solid.points) points.push_back(camera_(to_world * x));
  std::map<EdgeKey, std::vector<std::size_t>> beside;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const std::vector<int>& face = solid.faces[f];
    normals.push_back(normal_of(points, face));
    for (std::size_t i = 0; i < face.size(); ++i) beside[edge_of(face, i)].push_back(f);
  }
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    if (solid.closed && normals[f].z() <= 0) continue;
    const std::vector<int>& face = solid.faces[f];
    const double side = normals[f].z() < 0 ? -1 : 1;
    Face seen{{}, lit(colour, side * normals[f]), opacity, shines_, {}};
    for (std::size_t i = 0; i < face.size(); ++i) {
      seen.corners.push_back(points[static_cast<std::size_t>(face[i])]);
      seen.lines.push_back(opacity == 1 && is_line(normals, beside[edge_of(face, i)], solid.edges));
    }
    faces_.push_back(std::move(seen));
  }
}

void Painter::add_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double width, Rgb colour,
                       double opacity) {
  const Eigen::Vector3d from = camera_(a), to = camera_(b);
  const Eigen::Vector3d along = to - from;
  const Eigen::Vector3d across = Eigen::Vector3d(-along.y(), along.x(), 0).normalized() * width / 2;
  faces_.push_back(
      {{from - across, to - across, to + across, from + across}, colour, opacity, shines_, {}});
}

}  // namespace maxwrench
