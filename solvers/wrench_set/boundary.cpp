#include "solvers/wrench_set/boundary.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace maxwrench {
namespace {

using Indices = std::vector<int>;

/// For each entry of the lists, the indices of the lists that contain it, in increasing order.
std::vector<Indices> transposed(const std::vector<Indices>& lists, std::size_t entries) {
  std::vector<Indices> result(entries);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    for (const int entry : lists[i]) {
      result[static_cast<std::size_t>(entry)].push_back(static_cast<int>(i));
    }
  }
  return result;
}

/// The indices of the lists that are in no other list; of equal lists the first. `inverse` is
/// transposed(lists).
Indices largest(const std::vector<Indices>& lists, const std::vector<Indices>& inverse) {
  Indices result;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const Indices& own = lists[i];
    if (own.empty()) continue;
    // A list that contains this one contains its first entry.
    const Indices& others = inverse[static_cast<std::size_t>(own.front())];
    const bool within = std::any_of(others.begin(), others.end(), [&](int j) {
      const Indices& other = lists[static_cast<std::size_t>(j)];
      return j != static_cast<int>(i) &&
             (other.size() > own.size() ||
              (other.size() == own.size() && j < static_cast<int>(i))) &&
             std::includes(other.begin(), other.end(), own.begin(), own.end());
    });
    if (!within) result.push_back(static_cast<int>(i));
  }
  return result;
}

/// Sorts vertices of a facet counterclockwise about its normal.
void sort_around(const Eigen::Vector3d& normal, const std::vector<Eigen::Vector3d>& vertices,
                 Indices& face) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int i : face) centre += vertices[static_cast<std::size_t>(i)];
  centre /= static_cast<double>(face.size());
  const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
  const auto angle = [&](int i) {
    const Eigen::Vector3d from = vertices[static_cast<std::size_t>(i)] - centre;
    return std::atan2(y.dot(from), x.dot(from));
  };
  std::sort(face.begin(), face.end(), [&](int a, int b) { return angle(a) < angle(b); });
}

/// Whether each edge of a face is the edge of one other, in the other direction.
bool closes(const std::vector<Indices>& faces) {
  std::set<std::pair<int, int>> edges;
  for (const Indices& face : faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      if (!edges.emplace(face[i], face[(i + 1) % face.size()]).second) return false;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.contains({edge.second, edge.first});
  });
}

/// Puts vertices and edges of a polygon in counterclockwise order. False: they are no polygon.
bool order_polygon(const std::vector<HalfSpace>& half_spaces,
                   const std::vector<Eigen::Vector3d>& vertices, Boundary& boundary) {
  const std::size_t n = boundary.vertices.size();
  if (n < 3 || boundary.faces.size() != n) return false;
  std::vector<std::pair<int, int>> next(n, {-1, -1});  // vertex, edge
  for (std::size_t i = 0; i < n; ++i) {
    if (boundary.faces[i].size() != 2) return false;
    int a = boundary.faces[i][0], b = boundary.faces[i][1];
    const Eigen::Vector3d& normal =
        half_spaces[static_cast<std::size_t>(boundary.facets[i])].normal;
    const Eigen::Vector3d along(-normal.y(), normal.x(), 0);
    if (along.dot(vertices[static_cast<std::size_t>(b)] - vertices[static_cast<std::size_t>(a)]) <
        0)
      std::swap(a, b);
    next[static_cast<std::size_t>(a)] = {b, boundary.facets[i]};
  }
  Boundary ordered;
  int at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [to, edge] = next[static_cast<std::size_t>(at)];
    if (to < 0 || (to == 0) != (i + 1 == n)) return false;
    ordered.vertices.push_back(boundary.vertices[static_cast<std::size_t>(at)]);
    ordered.facets.push_back(edge);
    ordered.faces.push_back({static_cast<int>(i), static_cast<int>((i + 1) % n)});
    at = to;
  }
  boundary = std::move(ordered);
  return true;
}

}  // namespace

std::optional<Boundary> boundary_of(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<HalfSpace>& half_spaces, int q,
                                    double tolerance) {
  std::vector<Indices> at(points.size());  // the half spaces that a point lies on
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < half_spaces.size(); ++j) {
      const double inside = half_spaces[j].offset - half_spaces[j].normal.dot(points[i]);
      if (std::abs(inside) <= tolerance) at[i].push_back(static_cast<int>(j));
    }
  }
  Boundary boundary;
  boundary.vertices = largest(at, transposed(at, half_spaces.size()));
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Indices> at_vertices;
  for (const int i : boundary.vertices) {
    vertices.push_back(points[static_cast<std::size_t>(i)]);
    at_vertices.push_back(at[static_cast<std::size_t>(i)]);
  }
  const std::vector<Indices> on = transposed(at_vertices, half_spaces.size());
  for (const int j : largest(on, at_vertices)) {
    const Indices& face = on[static_cast<std::size_t>(j)];
    if (static_cast<int>(face.size()) < q) continue;
    boundary.facets.push_back(j);
    boundary.faces.push_back(face);
  }
  if (q == 1) {
    const bool two_ends = vertices.size() == 2 && boundary.faces.size() == 2;
    return two_ends ? std::optional(boundary) : std::nullopt;
  }
  if (q == 2) {
    return order_polygon(half_spaces, vertices, boundary) ? std::optional(boundary) : std::nullopt;
  }
  for (std::size_t i = 0; i < boundary.faces.size(); ++i) {
    sort_around(half_spaces[static_cast<std::size_t>(boundary.facets[i])].normal, vertices,
                boundary.faces[i]);
  }
  const bool solid = boundary.faces.size() >= 4 && closes(boundary.faces);
  return solid ? std::optional(boundary) : std::nullopt;
}

}  // namespace maxwrench
