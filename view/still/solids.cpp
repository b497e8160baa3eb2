#include "view/still/solids.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "lib/math/quick_hull.h"
#include "problems/mesh/thin_out.h"
#include "view/base64.h"
#include "view/still/numbers.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;
using Point3 = Eigen::Vector3d;

constexpr int kSides = 20;             ///< around a round body
constexpr int kRings = 4;              ///< from its equator to a pole
constexpr int kTubeSides = 6;          ///< around a thin one
constexpr double kSmallRadius = 0.05;  ///< of the extent of what grows by it

constexpr double kTurn = 2 * std::numbers::pi;

Point3 on_circle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The body that turns about z, from profile points (radius, z) that lead up. A point on the axis
/// is a pole. Ends that are no poles are open.
Solid turned(const std::vector<Eigen::Vector2d>& profile, int sides) {
  Solid solid;
  std::vector<std::vector<int>> rings;
  for (const Eigen::Vector2d& at : profile) {
    std::vector<int>& ring = rings.emplace_back();
    const bool pole = at.x() == 0;
    for (int i = 0; i < (pole ? 1 : sides); ++i) {
      ring.push_back(static_cast<int>(solid.points.size()));
      solid.points.push_back(on_circle(at.x(), kTurn * i / sides, at.y()));
    }
  }
  const auto at = [](const std::vector<int>& ring, int i) {
    return ring[static_cast<std::size_t>(i) % ring.size()];
  };
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (int i = 0; i < sides; ++i) {
      std::vector<int> face = {at(rings[k], i), at(rings[k], i + 1), at(rings[k + 1], i + 1),
                               at(rings[k + 1], i)};
      face.erase(std::unique(face.begin(), face.end()), face.end());
      if (face.front() == face.back()) face.pop_back();
      solid.faces.push_back(std::move(face));
    }
  }
  return solid;
}

/// The faces of the convex hull; a hull without volume has its two sides.
Solid hull(const std::vector<Point3>& points) {
  Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  Solid solid;
  solid.points = points;
  for (const HullFacet& facet : quick_hull(columns).facets) {
    const Point3 normal = facet.normal;
    const Point3 along = normal.unitOrthogonal(), across = normal.cross(along);
    Point3 middle = Point3::Zero();
    for (const int i : facet.vertices) middle += points[static_cast<std::size_t>(i)];
    middle /= static_cast<double>(facet.vertices.size());
    std::vector<std::pair<double, int>> around;
    for (const int i : facet.vertices) {
      const Point3 from = points[static_cast<std::size_t>(i)] - middle;
      around.emplace_back(std::atan2(from.dot(across), from.dot(along)), i);
    }
    std::sort(around.begin(), around.end());
    std::vector<int>& face = solid.faces.emplace_back();
    for (const auto& [angle, i] : around) face.push_back(i);
  }
  return solid;
}

/// All points within `radius` of the points, as the hull of many. A small radius needs few.
std::vector<Point3> grown(const std::vector<Point3>& points, double radius) {
  Eigen::AlignedBox3d box;
  for (const Point3& point : points) box.extend(point);
  std::vector<Point3> around;
  if (radius < kSmallRadius * box.sizes().maxCoeff()) {
    for (const int i : {0, 1, 2})
      around.insert(around.end(), {radius * Point3::Unit(i), -radius * Point3::Unit(i)});
  } else {
    around = sphere(radius).points;
  }
  std::vector<Point3> all;
  for (const Point3& point : points) {
    for (const Point3& x : around) all.push_back(point + x);
  }
  return all;
}

Solid hull_solid(const ordered_json& body) {
  const std::vector<Point3> points = points_of(body["points"]);
  const double radius = body["radius"].get<double>();
  if (points.size() <= 2) {
    return capsule(points.front(), points.back(), radius > 0 ? radius : 0.005);
  }
  return hull(radius > 0 ? grown(points, radius) : points);
}

/// The mesh of a part as `mesh_json` writes it, with at most `most` triangles.
Solid mesh_solid(const ordered_json& body, std::size_t most) {
  const Point3 low = points_of(body["low"]).front(), extent = points_of(body["extent"]).front();
  const std::string steps = from_base64(body["vertices"].get<std::string>()),
                    indices = from_base64(body["triangles"].get<std::string>());
  const auto number = [](const std::string& bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
      value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  };
  Triangles mesh;
  for (std::size_t at = 0; at + 6 <= steps.size(); at += 6) {
    const Eigen::Vector3d share(number(steps, at, 2), number(steps, at + 2, 2),
                                number(steps, at + 4, 2));
    mesh.points.emplace_back(low + share.cwiseProduct(extent) / 65535);
  }
  for (std::size_t at = 0; at + 12 <= indices.size(); at += 12) {
    mesh.triangles.emplace_back(number(indices, at, 4), number(indices, at + 4, 4),
                                number(indices, at + 8, 4));
  }
  const Triangles few = thinned_out(mesh, most);
  Solid solid;
  solid.closed = solid.edges = false;
  solid.points = few.points;
  for (const Eigen::Vector3i& t : few.triangles) solid.faces.push_back({t[0], t[1], t[2]});
  return solid;
}

}  // namespace

Solid capsule(const Point3& a, const Point3& b, double radius) {
  const double length = (b - a).norm();
  std::vector<Eigen::Vector2d> profile;
  for (const double end : {-1.0, 1.0}) {
    for (int i = 0; i <= kRings; ++i) {
      const double angle = kTurn / 4 * (end < 0 ? kRings - i : i) / kRings;
      const bool pole = i == (end < 0 ? 0 : kRings);
      profile.emplace_back(pole ? 0 : radius * std::cos(angle),
                           end * (length / 2 + radius * std::sin(angle)));
    }
  }
  if (length < 1e-9) profile.erase(profile.begin() + kRings);
  Eigen::Affine3d to = Eigen::Affine3d::Identity();
  to.translation() = (a + b) / 2;
  if (length > 1e-9) {
    to.linear() = Eigen::Quaterniond::FromTwoVectors(Point3::UnitZ(), b - a).toRotationMatrix();
  }
  return moved(turned(profile, kSides), to);
}

Solid sphere(double radius) { return capsule(Point3::Zero(), Point3::Zero(), radius); }

Solid cylinder(double radius, double length, bool caps) {
  Solid solid = turned({{radius, -length / 2}, {radius, length / 2}}, kSides);
  solid.closed = caps;
  if (!caps) return solid;
  std::vector<int>&bottom = solid.faces.emplace_back(), &top = solid.faces.emplace_back();
  for (int i = 0; i < kSides; ++i) {
    bottom.push_back(kSides - 1 - i);
    top.push_back(kSides + i);
  }
  return solid;
}

Solid cone(double radius, double length) {
  Solid solid = turned({{0, 0}, {radius, 0}, {0, length}}, 12);
  return solid;
}

Solid box(const Point3& size) {
  Solid solid;
  for (int i = 0; i < 8; ++i) {
    solid.points.emplace_back((i & 1 ? 0.5 : -0.5) * size.x(), (i & 2 ? 0.5 : -0.5) * size.y(),
                              (i & 4 ? 0.5 : -0.5) * size.z());
  }
  solid.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return solid;
}

Solid ring(double radius, double tube, double angle) {
  Solid solid;
  const int steps = std::max(1, static_cast<int>(std::lround(36 * angle / kTurn)));
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j < kTubeSides; ++j) {
      const double a = angle * i / steps, b = kTurn * j / kTubeSides;
      solid.points.push_back(on_circle(radius + tube * std::cos(b), a, tube * std::sin(b)));
    }
  }
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < kTubeSides; ++j) {
      const int a = i * kTubeSides, next = (j + 1) % kTubeSides;
      solid.faces.push_back({a + j, a + kTubeSides + j, a + kTubeSides + next, a + next});
    }
  }
  return solid;
}

Eigen::Affine3d placed(const Point3& at, const Point3& along) {
  Eigen::Affine3d to = Eigen::Affine3d::Identity();
  to.translation() = at;
  to.linear() = Eigen::Quaterniond::FromTwoVectors(Point3::UnitZ(), along).toRotationMatrix();
  return to;
}

Solid moved(Solid solid, const Eigen::Affine3d& to) {
  for (Point3& x : solid.points) x = to * x;
  if (to.linear().determinant() < 0) {
    for (std::vector<int>& face : solid.faces) std::reverse(face.begin(), face.end());
  }
  return solid;
}

Solid solid_of(const ordered_json& body, std::size_t triangles) {
  const std::string kind = body["kind"];
  if (kind == "hull") return hull_solid(body);
  const Eigen::Affine3d pose = pose_at(body["pose"]);
  if (kind == "mesh") return moved(mesh_solid(body, triangles), pose);
  const Point3 size = points_of(body["size"]).front();
  if (kind == "box") return moved(box(size), pose);
  const Solid unit = kind == "sphere" ? sphere(0.5) : cylinder(0.5, 1);
  return moved(unit, pose * Eigen::Scaling(size));
}

}  // namespace maxwrench
