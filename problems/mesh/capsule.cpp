#include "problems/mesh/capsule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace maxwrench {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kFirstTurn = 0.3;        ///< [rad]
constexpr double kLastTurn = 1e-3;        ///< [rad]
constexpr double kWorthwhile = 1 - 1e-6;  ///< of the volume, for another turn
constexpr double kRoundingUp = 1e-9;      ///< relative growth of the radius

struct Circle {
  Vector2d centre = Vector2d::Zero();
  double radius = 0;
  bool contains(const Vector2d& x) const {
    return (x - centre).norm() <= radius * (1 + 1e-12) + 1e-15;
  }
};

Circle circle_through(const Vector2d& a, const Vector2d& b) {
  return {(a + b) / 2, (a - b).norm() / 2};
}

/// The circle through three points; of three on a line, the one about the farthest two.
Circle circle_through(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a, v = c - a;
  const double twice = 2 * (u.x() * v.y() - u.y() * v.x());
  if (std::abs(twice) < 1e-14 * u.norm() * v.norm()) {
    const Circle ab = circle_through(a, b), ac = circle_through(a, c), bc = circle_through(b, c);
    return std::max({ab, ac, bc},
                    [](const Circle& p, const Circle& q) { return p.radius < q.radius; });
  }
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  const Vector2d from_a((v.y() * uu - u.y() * vv) / twice, (u.x() * vv - v.x() * uu) / twice);
  return {a + from_a, from_a.norm()};
}

/// The smallest circle around points: Welzl's algorithm as three loops.
Circle smallest_circle(const std::vector<Vector2d>& x) {
  Circle circle{x[0], 0};
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (circle.contains(x[i])) continue;
    circle = {x[i], 0};
    for (std::size_t j = 0; j < i; ++j) {
      if (circle.contains(x[j])) continue;
      circle = circle_through(x[i], x[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!circle.contains(x[k])) circle = circle_through(x[i], x[j], x[k]);
      }
    }
  }
  return circle;
}

/// A capsule about the axis from `from` to `to`.
struct Capsule {
  Vector3d from, to;
  double radius = 0;
  double volume() const {
    return std::numbers::pi * radius * radius * ((to - from).norm() + 4.0 / 3 * radius);
  }
};

double axis_distance(const Capsule& capsule, const Vector3d& x) {
  const Vector3d u = capsule.to - capsule.from;
  const double squared = u.squaredNorm();
  const double t = squared > 0 ? std::clamp((x - capsule.from).dot(u) / squared, 0.0, 1.0) : 0;
  return (capsule.from + t * u - x).norm();
}

/// The thinnest capsule along u, as short as its round ends allow. The radius is computed from the
/// axis in the end, so the points are inside whatever was rounded before.
Capsule capsule_along(const Points& points, const Vector3d& u) {
  const Vector3d e = u.unitOrthogonal(), f = u.cross(e);
  std::vector<Vector2d> across;
  for (const Vector3d& x : points) across.emplace_back(e.dot(x), f.dot(x));
  const Circle circle = smallest_circle(across);
  double low = kInfinity, high = -kInfinity;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double squared = (across[i] - circle.centre).squaredNorm();
    const double cap = std::sqrt(std::max(circle.radius * circle.radius - squared, 0.0));
    low = std::min(low, u.dot(points[i]) + cap);
    high = std::max(high, u.dot(points[i]) - cap);
  }
  if (low > high) low = high = (low + high) / 2;  // a sphere
  const Vector3d foot = circle.centre.x() * e + circle.centre.y() * f;
  Capsule capsule{foot + low * u, foot + high * u};
  for (const Vector3d& x : points) {
    capsule.radius = std::max(capsule.radius, axis_distance(capsule, x));
  }
  return capsule;
}

/// Turns the axis about two axes across it, by less and less.
Capsule improved(const Points& points, const Vector3d& start) {
  Vector3d u = start;
  Capsule best = capsule_along(points, u);
  for (double turn = kFirstTurn; turn > kLastTurn;) {
    const Vector3d e = u.unitOrthogonal(), f = u.cross(e);
    bool better = false;
    for (const Vector3d& to : {e, Vector3d(-e), f, Vector3d(-f)}) {
      const Vector3d turned = (u + turn * to).normalized();
      const Capsule capsule = capsule_along(points, turned);
      if (capsule.volume() >= kWorthwhile * best.volume()) continue;
      best = capsule;
      u = turned;
      better = true;
      break;
    }
    if (!better) turn /= 2;
  }
  return best;
}

}  // namespace

Shape capsule_around(const std::vector<Eigen::Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : points) mean += x / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3d& x : points) spread += (x - mean) * (x - mean).transpose();
  Eigen::Matrix<double, 3, 6> axes;
  axes << Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors(),
      Eigen::Matrix3d::Identity();
  Capsule best = improved(points, axes.col(0));
  for (int i = 1; i < axes.cols(); ++i) {
    const Capsule capsule = improved(points, axes.col(i));
    if (capsule.volume() < best.volume()) best = capsule;
  }
  Shape shape;
  shape.kind = Shape::Kind::kCapsule;
  const Vector3d along = best.to - best.from;
  shape.half_length = along.norm() / 2;
  shape.radius = best.radius * (1 + kRoundingUp);
  shape.placement.p = (best.from + best.to) / 2;
  if (shape.half_length > 0) {
    shape.placement.R =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), along).toRotationMatrix();
  }
  return shape;
}

}  // namespace maxwrench
