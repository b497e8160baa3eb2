#include "problems/collision/collision.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "problems/collision/distance.h"

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
    case Shape::Kind::kHull:
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
    case Shape::Kind::kHull:
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
  const fcl::CollisionRequestd request;  // only whether they collide, by libccd
  fcl::CollisionResultd result;
  return fcl::collide(&a, to_fcl(pose_a), &b, to_fcl(pose_b), request, result) > 0;
}

/// A shape at the pose of its link.
struct Placed {
  Pose<double> pose;          ///< R is set only if the shape is a box or uses FCL
  Eigen::Vector3d half_axis;  ///< of a capsule
};

Placed place(const Shape& shape, const Pose<double>& link, bool oriented) {
  Placed placed;
  placed.pose.p = link.R * shape.placement.p + link.p;
  if (oriented) placed.pose.R = link.R * shape.placement.R;
  placed.half_axis = shape.half_length * (link.R * shape.placement.R.col(2));
  return placed;
}

bool capsules_closer(const Shape& a, const Placed& at_a, const Shape& b, const Placed& at_b,
                     double margin) {
  const Eigen::Vector3d &p = at_a.pose.p, &q = at_b.pose.p;
  return segment_distance(p - at_a.half_axis, p + at_a.half_axis, q - at_b.half_axis,
                          q + at_b.half_axis) < a.radius + b.radius + margin;
}

/// A first test excludes capsules whose centre is too far from the box for their length to matter.
bool capsule_box_closer(const Shape& capsule, const Placed& at, const Shape& box,
                        const Pose<double>& box_pose, double margin) {
  const double reach = capsule.radius + margin;
  const Eigen::Vector3d centre = box_pose.R.transpose() * (at.pose.p - box_pose.p);
  const double far = capsule.half_length + reach;
  const Eigen::Vector3d outside = (centre.cwiseAbs() - box.half_sizes).cwiseMax(0.0);
  if (outside.squaredNorm() > far * far) return false;
  const Eigen::Vector3d half_axis = box_pose.R.transpose() * at.half_axis;
  return segment_box_distance(centre - half_axis, centre + half_axis, box.half_sizes) < reach;
}

/// The closest points of a capsule's axis and a box, in the frame in which both are placed.
Between capsule_to_box(const Placed& at, const Shape& box, const Pose<double>& box_pose) {
  const Pose<double> into = box_pose.inverse();
  const Eigen::Vector3d centre = into.R * at.pose.p + into.p;
  const Eigen::Vector3d half_axis = into.R * at.half_axis;
  Between between = segment_to_box(centre - half_axis, centre + half_axis, box.half_sizes);
  for (Eigen::Vector3d* x : {&between.on_a, &between.on_b}) *x = box_pose.R * *x + box_pose.p;
  return between;
}

/// Sets `core` to a box such that the shape contains all points within a radius of it, and returns
/// this radius. For a capsule and a box these points are the whole shape.
double core_of(const Shape& shape, InscribedBox& core) {
  core.link = shape.link;
  core.placement = shape.placement;
  if (is(shape, Shape::Kind::kBox)) {
    core.half_sizes = shape.half_sizes;
    return 0;
  }
  const bool capsule = is(shape, Shape::Kind::kCapsule);
  const double radius = capsule ? shape.radius : std::min(shape.radius, shape.half_length);
  core.half_sizes = {0, 0, capsule ? shape.half_length : shape.half_length - radius};
  return radius;
}

/// Two shapes on different links, with their FCL shapes if there is no exact test.
struct Pair {
  int a, b;
  double reach;  ///< shapes whose centres are farther apart than this cannot collide
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

bool collide(const Pair& pair, const Shape& a, const Placed& at_a, const Shape& b,
             const Placed& at_b, double margin) {
  if (pair.geometry_a) {
    return intersect(*pair.geometry_a, at_a.pose, *pair.geometry_b, at_b.pose);
  }
  if (is(a, Shape::Kind::kBox)) return capsule_box_closer(b, at_b, a, at_a.pose, margin);
  if (is(b, Shape::Kind::kBox)) return capsule_box_closer(a, at_a, b, at_b.pose, margin);
  return capsules_closer(a, at_a, b, at_b, margin);
}

class ShapePairs : public CollisionChecker {
 public:
  /// Exact pairs come first, because FCL's tests are far more expensive. Then pairs with a large
  /// reach come first, because they are more likely to collide.
  ShapePairs(std::vector<Shape> shapes, std::vector<Pair> pairs, double margin)
      : shapes_(std::move(shapes)), pairs_(std::move(pairs)), margin_(margin) {
    std::stable_sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
      const bool a_exact = a.geometry_a == nullptr, b_exact = b.geometry_a == nullptr;
      return a_exact != b_exact ? a_exact : a.reach > b.reach;
    });
    for (const Shape& shape : shapes_) {
      oriented_.push_back(is(shape, Shape::Kind::kBox));
      fixed_.push_back(place(shape, {}, true));
    }
    for (const Pair& pair : pairs_) {
      if (pair.geometry_a) oriented_[index(pair.a)] = oriented_[index(pair.b)] = true;
    }
  }

  int colliding_pair(const std::vector<Pose<double>>& links) const override {
    thread_local std::vector<Placed> moving;  // allocates when it grows, not at every posture
    moving.resize(shapes_.size());
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const int link = shapes_[i].link;
      if (link > 0) moving[i] = place(shapes_[i], links[index(link)], oriented_[i]);
    }
    const auto placed = [&](std::size_t i) -> const Placed& {
      return shapes_[i].link > 0 ? moving[i] : fixed_[i];
    };
    const auto found = std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
      const Placed &a = placed(index(pair.a)), &b = placed(index(pair.b));
      return (a.pose.p - b.pose.p).squaredNorm() <= pair.reach * pair.reach &&
             collide(pair, shapes_[index(pair.a)], a, shapes_[index(pair.b)], b, margin_);
    });
    return found == pairs_.end() ? -1 : static_cast<int>(found - pairs_.begin());
  }

  bool nearest(const std::vector<Pose<double>>& links, int i,
               ClosestPoints& result) const override {
    const Pair& pair = pairs_[index(i)];
    if (pair.geometry_a) return false;
    const bool box_first = is(shapes_[index(pair.a)], Shape::Kind::kBox);
    const Shape& a = shapes_[index(box_first ? pair.b : pair.a)];  // a capsule
    const Shape& b = shapes_[index(box_first ? pair.a : pair.b)];
    const Placed at_a = place(a, links[index(a.link)], true);
    const Placed at_b = place(b, links[index(b.link)], true);
    Between between;
    if (is(b, Shape::Kind::kBox)) {
      between = capsule_to_box(at_a, b, at_b.pose);
    } else {
      between = segment_to_segment(at_a.pose.p - at_a.half_axis, at_a.pose.p + at_a.half_axis,
                                   at_b.pose.p - at_b.half_axis, at_b.pose.p + at_b.half_axis);
    }
    const double distance = (between.on_a - between.on_b).norm();
    result = {distance - a.radius - b.radius - margin_, a.link, b.link, between.on_a, between.on_b};
    return true;
  }

  int pairs() const override { return static_cast<int>(pairs_.size()); }

  bool inscribed_boxes(int i, InscribedBoxPair& result) const override {
    const Pair& pair = pairs_[index(i)];
    const double radius = core_of(shapes_[index(pair.a)], result.a);
    result.reach = radius + core_of(shapes_[index(pair.b)], result.b) + margin_;
    return true;
  }

  std::string pair_name(int i) const override {
    const Pair& pair = pairs_[index(i)];
    return shapes_[index(pair.a)].body + " and " + shapes_[index(pair.b)].body;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::vector<Shape> shapes_;
  std::vector<Placed> fixed_;   ///< the placed shapes of the base
  std::vector<bool> oriented_;  ///< whether a shape's test needs its rotation
  std::vector<Pair> pairs_;
  double margin_;
};

}  // namespace

ConvexBody to_convex_body(const Shape& shape) {
  ConvexBody solid;
  solid.link = shape.link;
  const auto add = [&](double x, double y, double z) {
    solid.points.emplace_back(shape.placement.R * Eigen::Vector3d(x, y, z) + shape.placement.p);
  };
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
      case Shape::Kind::kHull:
        break;
      case Shape::Kind::kCylinder:
        for (int i = 0; i < kFaces; ++i) {
          const double angle = 2 * std::numbers::pi * i / kFaces;
          add(shape.radius * std::cos(angle), shape.radius * std::sin(angle),
              end * shape.half_length);
        }
        break;
    }
  }
  return solid;
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
