#include "problems/collision/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace maxwrench {

double bounding_radius(const Shape& shape) {
  switch (shape.kind) {
    case Shape::Kind::kCapsule:
      return shape.half_length + shape.radius;
    case Shape::Kind::kCylinder:
      return std::hypot(shape.half_length, shape.radius);
    case Shape::Kind::kBox:
      return shape.half_sizes.norm();
    case Shape::Kind::kHull:
      break;
  }
  double farthest = 0;
  for (const Eigen::Vector3d& x : shape.points) farthest = std::max(farthest, x.norm());
  return farthest + shape.radius;
}

/// A hull is centred if its middle is at most this share of its size from the origin. A centred one
/// is not moved, so that centring twice changes no digit.
constexpr double kCentred = 1e-12;

void centre_hull(Shape& shape) {
  if (!is(shape, Shape::Kind::kHull)) return;
  Eigen::Vector3d low = shape.points[0], high = low;
  for (const Eigen::Vector3d& x : shape.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Eigen::Vector3d middle = (low + high) / 2;
  if (middle.norm() <= kCentred * (high - low).norm()) return;
  for (Eigen::Vector3d& x : shape.points) x -= middle;
  shape.placement.p += shape.placement.R * middle;
}

RoundedCore rounded_core(const Shape& shape) {
  RoundedCore rounded;
  switch (shape.kind) {
    case Shape::Kind::kCapsule:
      rounded.core.half_sizes.z() = shape.half_length;
      rounded.rounding = shape.radius;
      break;
    case Shape::Kind::kCylinder:
      rounded.core.half_sizes.z() = shape.half_length;
      rounded.core.disc_radius = shape.radius;
      break;
    case Shape::Kind::kBox:
      rounded.core.half_sizes = shape.half_sizes;
      break;
    case Shape::Kind::kHull:
      rounded.core.points.resize(static_cast<Eigen::Index>(shape.points.size()), 3);
      for (std::size_t i = 0; i < shape.points.size(); ++i) {
        rounded.core.points.row(static_cast<Eigen::Index>(i)) = shape.points[i].transpose();
      }
      rounded.rounding = shape.radius;
      break;
  }
  return rounded;
}

double inner_core(const Shape& shape, InnerBody& core) {
  core.link = shape.link;
  core.placement = shape.placement;
  core.half_sizes.setZero();
  core.points.clear();
  if (is(shape, Shape::Kind::kHull)) {
    core.points = shape.points;
    return shape.radius;
  }
  if (is(shape, Shape::Kind::kBox)) {
    core.half_sizes = shape.half_sizes;
    return 0;
  }
  const bool capsule = is(shape, Shape::Kind::kCapsule);
  const double radius = capsule ? shape.radius : std::min(shape.radius, shape.half_length);
  core.half_sizes = {0, 0, capsule ? shape.half_length : shape.half_length - radius};
  return radius;
}

ConvexBody to_convex_body(const Shape& shape) {
  ConvexBody solid;
  solid.link = shape.link;
  const auto add = [&](double x, double y, double z) {
    solid.points.emplace_back(shape.placement.R * Eigen::Vector3d(x, y, z) + shape.placement.p);
  };
  if (is(shape, Shape::Kind::kHull)) {
    solid.radius = shape.radius;
    for (const Eigen::Vector3d& x : shape.points) add(x.x(), x.y(), x.z());
    return solid;
  }
  const Eigen::Vector3d& half = shape.half_sizes;
  constexpr int kFaces = 32;
  for (const double end : {-1.0, 1.0}) {
    switch (shape.kind) {
      case Shape::Kind::kCapsule:
        solid.radius = shape.radius;
        add(0, 0, end * shape.half_length);
        break;
      case Shape::Kind::kBox:
        for (const double x : {-1.0, 1.0}) {
          for (const double y : {-1.0, 1.0}) add(x * half.x(), y * half.y(), end * half.z());
        }
        break;
      case Shape::Kind::kCylinder:
        for (int i = 0; i < kFaces; ++i) {
          const double angle = 2 * std::numbers::pi * i / kFaces;
          add(shape.radius * std::cos(angle), shape.radius * std::sin(angle),
              end * shape.half_length);
        }
        break;
      case Shape::Kind::kHull:  // is done above
        break;
    }
  }
  return solid;
}

}  // namespace maxwrench
