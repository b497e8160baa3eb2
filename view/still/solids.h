#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The surface of a body, as flat convex faces.
struct Solid {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> faces;  ///< indices of points, counterclockwise from outside
  bool closed = true;  ///< whether only the outside can be seen; else both sides can
  bool edges = true;   ///< whether sharp edges are drawn as lines, beside the outline
};

/// The solid of a body of a scene (see `bodies_json`), in axes of its link.
///
/// @param body       the body
/// @param triangles  the most triangles of a mesh
Solid solid_of(const nlohmann::ordered_json& body, std::size_t triangles);

/// Within `radius` of the line from a to b.
Solid capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius);
/// About z, centred at the origin; without caps both sides can be seen.
Solid cylinder(double radius, double length, bool caps = true);
/// Along z from its base at z = 0 to its tip.
Solid cone(double radius, double length);
Solid sphere(double radius);
Solid box(const Eigen::Vector3d& size);
/// A tube around a circle about z, from the x axis by an angle [rad], without ends.
Solid ring(double radius, double tube, double angle);

/// What moves z to a direction, and the origin to a place.
Eigen::Affine3d placed(const Eigen::Vector3d& at, const Eigen::Vector3d& along);

Solid moved(Solid solid, const Eigen::Affine3d& to);

}  // namespace maxwrench
