#include "problems/mesh/hull.h"

#include <algorithm>
#include <queue>

#include "lib/math/gjk.h"
#include "lib/math/quick_hull.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// A point counts as inside a hull if it is nearer than this times the size of the points.
constexpr double kInside = 1e-12;

/// The vertices of the hull, or all points if Qhull finds no volume.
Points hull_vertices(const Points& points) {
  Eigen::MatrixXd columns(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  Points vertices;
  for (const int i : quick_hull(columns).vertices) {
    vertices.push_back(points[static_cast<std::size_t>(i)]);
  }
  return vertices.size() < 4 ? points : vertices;
}

double distance_from(const ConvexCore& hull, const Vector3d& x) {
  const Pose<double> none;
  ConvexCore point;
  return closest_points(hull, none, point, {Eigen::Matrix3d::Identity(), x}).distance();
}

void add_point(ConvexCore& hull, const Vector3d& x) {
  hull.points.conservativeResize(hull.points.rows() + 1, Eigen::NoChange);
  hull.points.bottomRows(1) = x.transpose();
}

/// A point and a distance from the hull that it does not exceed.
struct Candidate {
  double distance;
  std::size_t index;
  bool operator<(const Candidate& other) const { return distance < other.distance; }
};

/// The indices of the chosen points. The hull only grows, so an old distance is an upper bound, and
/// only those are computed anew that may be the largest.
std::vector<std::size_t> choose(const Points& points, std::size_t most, double inside,
                                double& left_out) {
  const auto first = static_cast<std::size_t>(
      std::max_element(points.begin(), points.end(),
                       [](const Vector3d& a, const Vector3d& b) { return a.x() < b.x(); }) -
      points.begin());
  std::vector<std::size_t> chosen = {first};
  ConvexCore hull;
  add_point(hull, points[first]);
  std::priority_queue<Candidate> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i != first) candidates.push({(points[i] - points[first]).norm(), i});
  }
  left_out = 0;
  while (!candidates.empty()) {
    Candidate next = candidates.top();
    candidates.pop();
    next.distance = std::min(next.distance, distance_from(hull, points[next.index]));
    if (!candidates.empty() && next.distance < candidates.top().distance) {
      if (next.distance > inside) candidates.push(next);
      continue;
    }
    if (next.distance <= inside) break;
    if (chosen.size() == most) {
      left_out = next.distance;
      break;
    }
    chosen.push_back(next.index);
    add_point(hull, points[next.index]);
  }
  return chosen;
}

}  // namespace

GrownHull hull_of(const std::vector<Eigen::Vector3d>& points, int most) {
  GrownHull hull;
  const Points vertices = hull_vertices(points);
  hull.vertices = static_cast<int>(vertices.size());
  double size = 0;
  for (const Vector3d& x : points) size = std::max(size, (x - points[0]).norm());
  if (vertices.size() <= 4) {
    hull.points = vertices;
  } else {
    // The greedy choice leaves out what is no vertex, which matters if Qhull found no volume.
    double left_out = 0;
    for (const std::size_t i :
         choose(vertices, static_cast<std::size_t>(most), kInside * size, left_out)) {
      hull.points.push_back(vertices[i]);
    }
    hull.radius = left_out > 0 ? left_out + kInside * size : 0;
    if (hull.radius == 0) hull.vertices = static_cast<int>(hull.points.size());
  }
  while (hull.points.size() < 4) hull.points.push_back(hull.points.back());
  return hull;
}

}  // namespace maxwrench
