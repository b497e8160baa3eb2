#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "problems/mesh/read_mesh.h"
#include "problems/mesh/thin_out.h"
#include "view/base64.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

constexpr std::size_t kMostTriangles = 6000;  ///< of a mesh: about 100 kB of the page

/// Stretches a mesh; one that is mirrored keeps its outside.
void stretch(const Eigen::Vector3d& size, Triangles& mesh) {
  for (Eigen::Vector3d& x : mesh.points) x = x.cwiseProduct(size);
  if (size.prod() > 0) return;
  for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

/// A part in the axes of the mesh.
nlohmann::ordered_json part_json(const Triangles& part) {
  Eigen::Vector3d low = part.points.front(), high = low;
  for (const Eigen::Vector3d& x : part.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Eigen::Vector3d extent = (high - low).cwiseMax(1e-9);
  std::string points, triangles;
  for (const Eigen::Vector3d& x : part.points) {
    const Eigen::Vector3d share = (x - low).cwiseQuotient(extent);
    for (const double s : share)
      append_bytes(static_cast<std::uint16_t>(std::lround(65535 * s)), points);
  }
  for (const Eigen::Vector3i& triangle : part.triangles) {
    for (const int i : triangle) append_bytes(static_cast<std::uint32_t>(i), triangles);
  }
  nlohmann::ordered_json json = {{"low", drawn_columns(low)},
                                 {"extent", drawn_columns(extent)},
                                 {"vertices", base64(points)},
                                 {"triangles", base64(triangles)}};
  if (part.colour) json["colour"] = *part.colour;
  return json;
}

std::size_t triangles_of(const std::vector<Triangles>& parts) {
  std::size_t count = 0;
  for (const Triangles& part : parts) count += part.triangles.size();
  return count;
}

}  // namespace

std::vector<nlohmann::ordered_json> mesh_json(const Visual& visual) {
  std::vector<Triangles> parts;
  try {
    parts = read_parts(visual.mesh);
  } catch (const std::invalid_argument&) {  // looks change no result
    return {};
  }
  const std::size_t all = triangles_of(parts);
  if (all == 0) return {};
  std::vector<nlohmann::ordered_json> json;
  for (const Triangles& part : parts) {
    // Each part has its share of the triangles.
    Triangles few = thinned_out(part, std::min(all, kMostTriangles) * part.triangles.size() / all);
    if (few.triangles.empty()) continue;
    stretch(visual.size, few);
    json.push_back(part_json(few));
  }
  return json;
}

}  // namespace maxwrench
