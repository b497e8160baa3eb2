#include "problems/mesh/mesh_shape.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "problems/make/bad_value.h"
#include "problems/mesh/capsule.h"
#include "problems/mesh/hull.h"
#include "problems/mesh/mesh_text.h"
#include "problems/mesh/read_mesh.h"

namespace maxwrench {
namespace {

constexpr double kMillimetre = 1e-3;     // m
constexpr double kFarthestVertex = 1e6;  // m; products of such numbers do not overflow

Shape hull_shape(const GrownHull& hull, std::string& note) {
  Shape shape;
  shape.kind = Shape::Kind::kHull;
  shape.points = hull.points;
  shape.radius = hull.radius;
  note = fmt::format("hull of {} vertices", hull.vertices);
  if (hull.radius > 0) {
    note = fmt::format("hull of {} of {} vertices, grown by {:.2g} mm", hull.points.size(),
                       hull.vertices, hull.radius / kMillimetre);
  }
  return shape;
}

MeshShape shape_from(const FoundMesh& found, const Eigen::Vector3d& scale, MeshUse use) {
  MeshShape result;
  result.file = found.file;
  try {
    std::vector<Eigen::Vector3d> points = read_mesh(found.file);
    for (Eigen::Vector3d& x : points) {
      x = x.cwiseProduct(scale);
      if (x.cwiseAbs().maxCoeff() <= kFarthestVertex) continue;
      throw_bad_mesh(found.file, fmt::format("vertex {}", shown(Eigen::VectorXd(x))),
                     fmt::format("coordinates within {} m", kFarthestVertex));
    }
    GrownHull hull = hull_of(points);
    if (use == MeshUse::kHull) {
      result.shape = hull_shape(hull, result.note);
    } else {
      // The capsule contains the grown hull if it contains the points and grows as much.
      result.shape = capsule_around(hull.points);
      result.shape->radius += hull.radius;
      result.note = fmt::format("capsule of radius {:.3g} mm and length {:.3g} mm",
                                result.shape->radius / kMillimetre,
                                2 * result.shape->half_length / kMillimetre);
    }
  } catch (const std::invalid_argument& error) {
    result.note = error.what();
  }
  return result;
}

}  // namespace

MeshShape MeshShapes::shape(const std::string& uri, const Eigen::Vector3d& scale, MeshUse use) {
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw BadValue("scale", shown(Eigen::VectorXd(scale)), "3 finite numbers other than 0");
  }
  const auto [entry, added] =
      known_.emplace(Key{uri, scale.x(), scale.y(), scale.z(), use}, MeshShape{});
  if (!added) return entry->second;
  const FoundMesh found = find(uri);
  if (found.file.empty()) {
    const std::string where = found.tried.empty()
                                  ? "expected a path, file://, package:// or model://"
                                  : fmt::format("tried {}", fmt::join(found.tried, ", "));
    entry->second.note = one_line(fmt::format("{}: not found; {}", uri.substr(0, 200), where));
  } else {
    entry->second = shape_from(found, scale, use);
  }
  return entry->second;
}

}  // namespace maxwrench
