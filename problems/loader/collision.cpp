#include "problems/loader/collision.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>

namespace maxwrench {
namespace {

using Geometry = fcl::CollisionGeometryd;

/// The FCL shape that contains every point within `margin` of the shape.
std::shared_ptr<const Geometry> grown(const Shape& shape, double margin) {
  const double r = shape.radius + margin;
  const double length = 2 * shape.half_length;
  const Eigen::Vector3d sides = 2 * (shape.half_sizes.array() + margin).matrix();
  switch (shape.kind) {
    case Shape::Kind::kCapsule:
      if (length == 0) return std::make_shared<fcl::Sphered>(r);
      return std::make_shared<fcl::Capsuled>(r, length);
    case Shape::Kind::kCylinder:
      return std::make_shared<fcl::Cylinderd>(r, length + 2 * margin);
    case Shape::Kind::kBox:
      break;
  }
  return std::make_shared<fcl::Boxd>(sides.x(), sides.y(), sides.z());
}

double bounding_radius(const Shape& shape) {
  switch (shape.kind) {
    case Shape::Kind::kCapsule:
      return shape.half_length + shape.radius;
    case Shape::Kind::kCylinder:
      return std::hypot(shape.half_length, shape.radius);
    case Shape::Kind::kBox:
      break;
  }
  return shape.half_sizes.norm();
}

bool is(const Shape& shape, Shape::Kind kind) { return shape.kind == kind; }

fcl::Transform3d to_fcl(const Pose<double>& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.R;
  transform.translation() = pose.p;
  return transform;
}

bool intersect(const Geometry& a, const Pose<double>& pose_a, const Geometry& b,
               const Pose<double>& pose_b) {
  const fcl::CollisionRequestd request;  // yes or no, by libccd
  fcl::CollisionResultd result;
  return fcl::collide(&a, to_fcl(pose_a), &b, to_fcl(pose_b), request, result) > 0;
}

/// End points of the axis.
Eigen::Vector3d tip(const Shape& shape, const Pose<double>& pose, double side) {
  return pose.p + side * shape.half_length * pose.R.col(2);
}

bool capsules_closer(const Shape& a, const Pose<double>& pose_a, const Shape& b,
                     const Pose<double>& pose_b, double margin) {
  return segment_distance(tip(a, pose_a, -1), tip(a, pose_a, 1), tip(b, pose_b, -1),
                          tip(b, pose_b, 1)) < a.radius + b.radius + margin;
}

bool capsule_box_closer(const Shape& capsule, const Pose<double>& pose, const Shape& box,
                        const Pose<double>& box_pose, double margin) {
  const Pose<double> local = box_pose.inverse() * pose;
  return segment_box_distance(tip(capsule, local, -1), tip(capsule, local, 1), box.half_sizes) <
         capsule.radius + margin;
}

/// Two shapes on different links, with the FCL shapes if no exact test is at hand.
struct Pair {
  int a, b;
  double reach;  ///< centres farther apart than this cannot collide
  std::shared_ptr<const Geometry> geometry_a, geometry_b;
};

bool exact(const Shape& a, const Shape& b) {
  return !is(a, Shape::Kind::kCylinder) && !is(b, Shape::Kind::kCylinder) &&
         (is(a, Shape::Kind::kCapsule) || is(b, Shape::Kind::kCapsule));
}

Pair make_pair(const std::vector<Shape>& shapes, int i, int j, double margin) {
  const Shape& a = shapes[static_cast<std::size_t>(i)];
  const Shape& b = shapes[static_cast<std::size_t>(j)];
  Pair pair{i, j, bounding_radius(a) + bounding_radius(b) + margin, nullptr, nullptr};
  if (exact(a, b)) return pair;
  const bool grow_b = is(b, Shape::Kind::kCapsule);  // growing a capsule is exact
  pair.geometry_a = grown(a, grow_b ? 0 : margin);
  pair.geometry_b = grown(b, grow_b ? margin : 0);
  return pair;
}

bool collide(const Pair& pair, const Shape& a, const Pose<double>& pose_a, const Shape& b,
             const Pose<double>& pose_b, double margin) {
  if (pair.geometry_a) return intersect(*pair.geometry_a, pose_a, *pair.geometry_b, pose_b);
  if (is(a, Shape::Kind::kBox)) return capsule_box_closer(b, pose_b, a, pose_a, margin);
  if (is(b, Shape::Kind::kBox)) return capsule_box_closer(a, pose_a, b, pose_b, margin);
  return capsules_closer(a, pose_a, b, pose_b, margin);
}

class ShapePairs : public CollisionChecker {
 public:
  ShapePairs(std::vector<Shape> shapes, std::vector<Pair> pairs, double margin)
      : shapes_(std::move(shapes)), pairs_(std::move(pairs)), margin_(margin) {}

  bool collides(const std::vector<Pose<double>>& links) const override {
    return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
      const Shape& a = shapes_[static_cast<std::size_t>(pair.a)];
      const Shape& b = shapes_[static_cast<std::size_t>(pair.b)];
      const Pose<double>& link_a = links[static_cast<std::size_t>(a.link)];
      const Pose<double>& link_b = links[static_cast<std::size_t>(b.link)];
      const Eigen::Vector3d apart =
          link_a.R * a.placement.p + link_a.p - link_b.R * b.placement.p - link_b.p;
      if (apart.squaredNorm() > pair.reach * pair.reach) return false;
      return collide(pair, a, link_a * a.placement, b, link_b * b.placement, margin_);
    });
  }

  int pairs() const override { return static_cast<int>(pairs_.size()); }

 private:
  std::vector<Shape> shapes_;
  std::vector<Pair> pairs_;
  double margin_;
};

double point_box_distance(const Eigen::Vector3d& x, const Eigen::Vector3d& half_sizes) {
  return (x.cwiseAbs() - half_sizes).cwiseMax(0.0).norm();
}

}  // namespace

double segment_distance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                        const Eigen::Vector3d& b0, const Eigen::Vector3d& b1) {
  // The squared distance |r + s u - t v|^2 is convex in (s, t). Its minimum over the square lies
  // inside (then the lines' nearest points are it) or on an edge (an end point of one segment).
  const Eigen::Vector3d u = a1 - a0, v = b1 - b0, r = a0 - b0;
  const auto to_point = [](const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
    const double squared = along.squaredNorm();
    const double t = squared > 0 ? std::clamp(-from.dot(along) / squared, 0.0, 1.0) : 0.0;
    return (from + t * along).squaredNorm();
  };
  double best =
      std::min({to_point(r, u), to_point(r - v, u), to_point(-r, v), to_point(-r - u, v)});
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  if (determinant > 1e-12 * uu * vv) {  // nearly parallel: an end point is as near, to 1e-6
    const double s = (uv * r.dot(v) - vv * r.dot(u)) / determinant;
    const double t = (uu * r.dot(v) - uv * r.dot(u)) / determinant;
    const bool inside = s > 0 && s < 1 && t > 0 && t < 1;
    if (inside) best = std::min(best, (r + s * u - t * v).squaredNorm());
  }
  return std::sqrt(best);
}

double segment_box_distance(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                            const Eigen::Vector3d& half_sizes) {
  const Eigen::Vector3d v = p1 - p0;
  // Half the derivative of the squared distance along the segment: piecewise linear, increasing,
  // with its breakpoints where the segment crosses a plane of a face.
  const auto slope = [&](double t) {
    const Eigen::Vector3d x = p0 + t * v;
    const Eigen::Vector3d outside = x - x.cwiseMax(-half_sizes).cwiseMin(half_sizes);
    return outside.dot(v);
  };
  double low = 0, high = 1;
  double slope_low = slope(low), slope_high = slope(high);
  if (slope_low >= 0) return point_box_distance(p0, half_sizes);
  if (slope_high <= 0) return point_box_distance(p1, half_sizes);
  for (int i = 0; i < 3; ++i) {
    if (v[i] == 0) continue;
    for (const double face : {-half_sizes[i], half_sizes[i]}) {
      const double t = (face - p0[i]) / v[i];
      if (!(t > low && t < high)) continue;
      const double slope_t = slope(t);
      (slope_t < 0 ? low : high) = t;
      (slope_t < 0 ? slope_low : slope_high) = slope_t;
    }
  }
  const double t = low + (high - low) * slope_low / (slope_low - slope_high);
  return point_box_distance(p0 + t * v, half_sizes);
}

bool closer_than(const Shape& a, const Pose<double>& pose_a, const Shape& b,
                 const Pose<double>& pose_b, double margin) {
  return collide(make_pair({a, b}, 0, 1, margin), a, pose_a, b, pose_b, margin);
}

std::shared_ptr<const CollisionChecker> make_collision_checker(
    std::vector<Shape> shapes, const std::vector<std::pair<std::string, std::string>>& ignore,
    double margin) {
  const auto ignored = [&ignore](const Shape& a, const Shape& b) {
    return std::any_of(ignore.begin(), ignore.end(), [&](const auto& pair) {
      return (pair.first == a.body && pair.second == b.body) ||
             (pair.first == b.body && pair.second == a.body);
    });
  };
  std::vector<Pair> pairs;
  const int count = static_cast<int>(shapes.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const Shape& a = shapes[static_cast<std::size_t>(i)];
      const Shape& b = shapes[static_cast<std::size_t>(j)];
      if (a.link != b.link && !ignored(a, b)) pairs.push_back(make_pair(shapes, i, j, margin));
    }
  }
  if (pairs.empty()) return nullptr;
  return std::make_shared<ShapePairs>(std::move(shapes), std::move(pairs), margin);
}

}  // namespace maxwrench
