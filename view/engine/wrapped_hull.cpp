#include "view/engine/wrapped_hull.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace maxwrench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points, lines and planes that are nearer than this share of the size of the set are the same.
constexpr double kSame = 1e-10;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The corners of the hull of points in a plane, counterclockwise, as indices; at least three or
/// none (Jarvis's march). Points on an edge are no corners.
std::vector<int> corners_of(const std::vector<Vector2d>& points, double size) {
  const auto at = [&](int i) -> const Vector2d& { return points[static_cast<std::size_t>(i)]; };
  const auto count = static_cast<int>(points.size());
  if (count < 3) return {};
  int start = 0;  // farthest from the first one, so a corner
  for (int i = 1; i < count; ++i) {
    if ((at(i) - at(0)).norm() > (at(start) - at(0)).norm()) start = i;
  }
  std::vector<int> corners;
  const auto same = [&](int i, int j) { return (at(i) - at(j)).norm() < kSame * size; };
  for (int from = start; corners.empty() || !same(from, start);) {
    if (static_cast<int>(corners.size()) == count) return {};  // rounding led astray
    corners.push_back(from);
    int next = -1;
    for (int i = 0; i < count; ++i) {
      if (same(i, from)) continue;
      const Vector2d to = at(i) - at(from);
      const Vector2d best = next < 0 ? to : at(next) - at(from);
      const double left = cross(best, to) / best.norm();
      if (next < 0 || left < -kSame * size || (left <= kSame * size && to.norm() > best.norm())) {
        next = i;
      }
    }
    if (next < 0) return {};
    from = next;
  }
  return corners.size() < 3 ? std::vector<int>() : corners;
}

class GiftWrapping {
 public:
  explicit GiftWrapping(const Eigen::MatrixXd& points) {
    size_ = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Vector3d x = points.col(i);
      const bool known = std::any_of(points_.begin(), points_.end(), [&](const Vector3d& other) {
        return (x - other).norm() < kSame * size_;
      });
      if (known) continue;
      points_.push_back(x);
      numbers_.push_back(static_cast<int>(i));
    }
  }

  Hull run() {
    if (!(size_ > 0) || !add_first() || !wrap()) return {};
    Hull hull;
    std::set<int> vertices;
    for (Facet& facet : facets_) {
      for (int& i : facet.corners) i = numbers_[static_cast<std::size_t>(i)];
      vertices.insert(facet.corners.begin(), facet.corners.end());
      hull.facets.push_back({facet.normal, std::move(facet.corners)});
    }
    hull.vertices.assign(vertices.begin(), vertices.end());
    return hull;
  }

 private:
  struct Facet {
    Vector3d normal;
    std::vector<int> corners;  ///< counterclockwise as seen from outside
  };

  const Vector3d& at(int i) const { return points_[static_cast<std::size_t>(i)]; }

  /// Turns a plane that supports the set about the line at `a` along `e`, as far as the set allows.
  /// `normal` is the outward normal of the plane, and then of the next one. False: all points are
  /// on one line across e.
  bool turn(const Vector3d& a, const Vector3d& e, Vector3d& normal) const {
    const Vector3d inward = normal.cross(e).normalized(), start = normal;
    double most = -1;
    for (const Vector3d& x : points_) {
      const double along = (x - a).dot(inward), below = -(x - a).dot(start);
      if (std::hypot(along, below) < kSame * size_) continue;
      // Rounding may put a point of the plane above it.
      most = std::max(most, std::atan2(std::max(below, 0.0), along));
    }
    if (most < 0) return false;
    normal = -std::sin(most) * inward - std::cos(most) * start;
    return refine(a, e, normal);
  }

  /// Lets the plane go through the point that is farthest from the line, of those on it, so that
  /// rounding counts least.
  bool refine(const Vector3d& a, const Vector3d& e, Vector3d& normal) const {
    const Vector3d outward = normal;
    double far = 0;
    Vector3d best = Vector3d::Zero();
    for (const Vector3d& x : points_) {
      if (std::abs((x - a).dot(outward)) > kSame * size_) continue;
      const Vector3d across = (x - a) - (x - a).dot(e) * e;
      if (across.norm() <= far) continue;
      far = across.norm();
      best = across;
    }
    if (far < kSame * size_) return false;
    normal = best.cross(e).normalized();
    if (normal.dot(outward) < 0) normal = -normal;
    return true;
  }

  /// A plane through the least point, in the order of x, y and z, turns until it meets a second
  /// one, and about the line through both until it meets a third one.
  bool add_first() {
    const auto before = [](const Vector3d& a, const Vector3d& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    const Vector3d first = *std::min_element(points_.begin(), points_.end(), before);
    Vector3d normal = -Vector3d::UnitX();
    if (!turn(first, Vector3d::UnitZ(), normal)) return false;
    if (add(normal, first.dot(normal))) return true;
    Vector3d e = Vector3d::Zero();
    for (const Vector3d& x : points_) {
      const Vector3d to = x - first;
      if (std::abs(to.dot(normal)) <= kSame * size_ && to.norm() > e.norm()) e = to;
    }
    e.normalize();
    return turn(first, e, normal) && add(normal, first.dot(normal));
  }

  /// Adds the facet on a plane, whose edges must be new. False: there is none, and nothing is
  /// added, or edges are not new.
  bool add(const Vector3d& normal, double offset) {
    const Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
    std::vector<int> on;
    std::vector<Vector2d> flat;
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      if (offset - normal.dot(at(i)) > kSame * size_) continue;
      on.push_back(i);
      flat.emplace_back(x.dot(at(i)), y.dot(at(i)));
    }
    Facet facet{normal, {}};
    for (const int i : corners_of(flat, size_)) {
      facet.corners.push_back(on[static_cast<std::size_t>(i)]);
    }
    const std::size_t count = facet.corners.size();
    if (count == 0) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::pair edge(facet.corners[i], facet.corners[(i + 1) % count]);
      if (!edges_.emplace(edge, facets_.size()).second) return false;
      open_.push_back(edge);
    }
    facets_.push_back(std::move(facet));
    return true;
  }

  /// Goes over all edges. False: facets do not meet as those of a hull do.
  bool wrap() {
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const auto [a, b] = open_[k];
      if (edges_.contains({b, a})) continue;
      Vector3d normal = facets_[edges_.at({a, b})].normal;
      if (!turn(at(a), (at(b) - at(a)).normalized(), normal)) return false;
      if (!add(normal, at(a).dot(normal)) || !edges_.contains({b, a})) return false;
    }
    return facets_.size() >= 4;
  }

  std::vector<Vector3d> points_;  ///< each place once
  std::vector<int> numbers_;      ///< of the points among those given
  double size_ = 0;
  std::vector<Facet> facets_;
  std::map<std::pair<int, int>, std::size_t> edges_;  ///< the facet of each edge
  std::vector<std::pair<int, int>> open_;
};

Hull flat_hull(const Eigen::MatrixXd& points) {
  std::vector<Vector2d> list;
  for (const auto& x : points.colwise()) list.emplace_back(x);
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  Hull hull;
  hull.vertices = corners_of(list, size);
  const std::size_t count = hull.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const int a = hull.vertices[i], b = hull.vertices[(i + 1) % count];
    const Vector2d along = points.col(b) - points.col(a);
    hull.facets.push_back({Vector2d(along.y(), -along.x()).normalized(), {a, b}});
  }
  return hull;
}

}  // namespace

Hull wrapped_hull(const Eigen::MatrixXd& points) {
  if (points.cols() <= points.rows()) return {};
  return points.rows() == 2 ? flat_hull(points) : GiftWrapping(points).run();
}

}  // namespace maxwrench
