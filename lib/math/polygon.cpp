#include "lib/math/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace maxwrench {
namespace {

/// If an edge is still pushed outwards after this many steps, the support function contradicts
/// itself.
constexpr int kMaxDepth = 64;

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

class Tracer {
 public:
  Tracer(const Support& support, double tolerance) : support_(support), tolerance_(tolerance) {}

  std::vector<Point> trace() {
    const std::array<Point, 4> axes = {Point(1, 0), Point(0, 1), Point(-1, 0), Point(0, -1)};
    std::array<Point, 4> extreme;
    for (int i = 0; i < 4; ++i) {
      const auto found = support_(axes[i]);
      if (!found) return {};
      extreme[i] = found->second;
    }
    for (const Point& p : extreme) length_ = std::max(length_, (p - extreme[0]).norm());
    length_ = std::max(length_, (extreme[3] - extreme[1]).norm());
    for (int i = 0; i < 4; ++i) {
      vertices_.push_back(extreme[i]);
      push_out(extreme[i], extreme[(i + 1) % 4], 0);
      if (failed_) return {};
    }
    merge();
    return vertices_;
  }

 private:
  double slack() const { return tolerance_ * length_; }

  /// Appends the vertices strictly between p and q.
  void push_out(const Point& p, const Point& q, int depth) {
    const Point edge = q - p;
    if (edge.norm() <= slack() || depth == kMaxDepth || failed_) return;
    const Point normal = Point(edge.y(), -edge.x()).normalized();
    const auto found = support_(normal);
    failed_ = !found;
    if (failed_ || found->first <= normal.dot(p) + slack()) return;
    const Point r = found->second;
    push_out(p, r, depth + 1);
    vertices_.push_back(r);
    push_out(r, q, depth + 1);
  }

  /// Drops repeated vertices and those in the interior of an edge. In a tie the support function
  /// may return any point of an edge.
  void merge() {
    bool changed = true;
    while (changed && vertices_.size() > 1) {
      changed = false;
      for (std::size_t i = 0; i < vertices_.size() && vertices_.size() > 1;) {
        const std::size_t n = vertices_.size();
        if (is_superfluous(vertices_[(i + n - 1) % n], vertices_[i], vertices_[(i + 1) % n])) {
          vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(i));
          changed = true;
        } else {
          ++i;
        }
      }
    }
  }

  bool is_superfluous(const Point& before, const Point& p, const Point& after) const {
    const Point in = p - before;
    const Point out = after - p;
    if (out.norm() <= slack()) return true;
    const double height = std::abs(cross(in, out)) / (after - before).norm();
    return in.dot(out) > 0 && height <= slack();
  }

  const Support& support_;
  double tolerance_;
  double length_ = 0;  // extent of the set, within a factor of two
  bool failed_ = false;
  std::vector<Point> vertices_;
};

}  // namespace

std::vector<Eigen::Vector2d> polygon_from_support(const Support& support, double tolerance) {
  return Tracer(support, tolerance).trace();
}

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  // Andrew's monotone chain.
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the first point of the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace maxwrench
