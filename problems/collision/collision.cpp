#include "problems/collision/collision.h"

#include <algorithm>
#include <cmath>

#include "lib/math/distance.h"
#include "lib/math/gjk.h"
#include "problems/collision/grown_shape.h"
#include "problems/collision/shapes.h"

namespace maxwrench {
namespace {

/// A shape at the pose of its link.
struct Placed {
  Pose<double> pose;          ///< R is set only where a test needs it
  Eigen::Vector3d half_axis;  ///< of a capsule
};

void place(const Shape& shape, const Pose<double>& link, bool oriented, Placed& placed) {
  placed.pose.p.noalias() = link.R * shape.placement.p;
  placed.pose.p += link.p;
  if (oriented) placed.pose.R.noalias() = link.R * shape.placement.R;
  placed.half_axis = shape.half_length * (link.R * shape.placement.R.col(2));
}

Placed place_oriented(const Shape& shape, const Pose<double>& link) {
  Placed placed;
  place(shape, link, true, placed);
  return placed;
}

/// How a pair is tested.
enum class Test {
  kCapsules,    ///< a closed formula
  kCapsuleBox,  ///< a closed formula
  kGjk,         ///< pairs with a hull
  kGrown        ///< all others: whether they intersect, one of them grown by the margin
};

Test test_of(const Shape& a, const Shape& b) {
  const auto any = [&](Shape::Kind kind) { return is(a, kind) || is(b, kind); };
  if (any(Shape::Kind::kHull)) return Test::kGjk;
  if (!any(Shape::Kind::kCapsule) || any(Shape::Kind::kCylinder)) return Test::kGrown;
  return any(Shape::Kind::kBox) ? Test::kCapsuleBox : Test::kCapsules;
}

/// Formulas take the least time, then GJK, then grown shapes.
int cost_of(Test test) { return test == Test::kGrown ? 2 : test == Test::kGjk ? 1 : 0; }

/// Two shapes on different links, with their grown shapes if these are tested. A box beside a
/// capsule is the second shape of a test.
struct Pair {
  int a, b;
  bool fixed_a, fixed_b;  ///< whether the shape is in the world
  bool box_first;         ///< whether a is a box and b a capsule
  bool aligned;           ///< whether the box is fixed and has the axes of the world
  Test test;
  double reach;   ///< shapes whose centres are farther apart than this cannot collide
  double radius;  ///< the distance of axes, or of an axis and a box, below which they collide
  std::shared_ptr<const GrownShape> grown_a, grown_b;
};

Pair make_pair(const std::vector<Shape>& shapes, int i, int j, double margin) {
  const Shape& a = shapes[static_cast<std::size_t>(i)];
  const Shape& b = shapes[static_cast<std::size_t>(j)];
  Pair pair{};
  pair.a = i;
  pair.b = j;
  pair.fixed_a = a.link <= 0;
  pair.fixed_b = b.link <= 0;
  pair.test = test_of(a, b);
  pair.box_first = pair.test == Test::kCapsuleBox && is(a, Shape::Kind::kBox);
  const Shape& box = pair.box_first ? a : b;
  pair.aligned = box.link <= 0 && box.placement.R.isIdentity(0);
  pair.reach = bounding_radius(a) + bounding_radius(b) + margin;
  const Shape& capsule = pair.box_first ? b : a;
  pair.radius = capsule.radius + (pair.test == Test::kCapsules ? b.radius : 0) + margin;
  if (pair.test != Test::kGrown) return pair;
  const bool grow_b = is(b, Shape::Kind::kCapsule);  // growing a capsule is exact
  pair.grown_a = make_grown_shape(a, grow_b ? 0 : margin);
  pair.grown_b = make_grown_shape(b, grow_b ? margin : 0);
  return pair;
}

/// Whether a plane separates capsules. With d = q - p and a normal n of the plane, their axes are
/// at least (n'd - |n'h_a| - |n'h_b|) / |n| apart. The first n is d. The second one is the line
/// from q to the nearest point of the axis of a, which is better if that is long.
bool separated_capsules(const Placed& a, const Placed& b, double radius) {
  const Eigen::Vector3d d = b.pose.p - a.pose.p;
  const double along_a = d.dot(a.half_axis);
  const auto separates = [&](double n_d, double n_a, double n_b, double squared) {
    const double apart = n_d - std::abs(n_a) - std::abs(n_b);
    return apart > 0 && apart * apart > radius * radius * squared;
  };
  const double squared = d.squaredNorm();
  if (separates(squared, along_a, d.dot(b.half_axis), squared)) return true;
  const double length = a.half_axis.squaredNorm();
  if (!(length > 0)) return false;
  const Eigen::Vector3d n = d - std::clamp(along_a / length, -1.0, 1.0) * a.half_axis;
  return separates(n.dot(d), n.dot(a.half_axis), n.dot(b.half_axis), n.squaredNorm());
}

bool capsules_closer(const Placed& a, const Placed& b, double radius) {
  const Eigen::Vector3d &p = a.pose.p, &q = b.pose.p;
  return segment_distance(p - a.half_axis, p + a.half_axis, q - b.half_axis, q + b.half_axis) <
         radius;
}

/// A capsule in the axes of a box at its centre.
struct CapsuleAtBox {
  Eigen::Vector3d centre, half_axis;
  CapsuleAtBox(const Placed& capsule, const Pose<double>& box, bool aligned)
      : centre(capsule.pose.p - box.p), half_axis(capsule.half_axis) {
    if (aligned) return;
    centre = box.R.transpose() * centre;
    half_axis = box.R.transpose() * half_axis;
  }
};

/// Whether the plane of a face separates a capsule from a box.
bool separated_from_box(const CapsuleAtBox& at, const Shape& box, double radius) {
  return (at.centre.cwiseAbs() - at.half_axis.cwiseAbs() - box.half_sizes).maxCoeff() > radius;
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

class ShapePairs : public CollisionChecker {
 public:
  /// Cheap tests come first, then pairs with a large reach, because they are more likely to
  /// collide.
  ShapePairs(Collision made_of, std::vector<Pair> pairs)
      : shapes_(std::move(made_of.shapes)),
        ignore_(std::move(made_of.ignore)),
        pairs_(std::move(pairs)),
        margin_(made_of.margin) {
    std::stable_sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
      const int cost_a = cost_of(a.test), cost_b = cost_of(b.test);
      return cost_a != cost_b ? cost_a < cost_b : a.reach > b.reach;
    });
    for (const Shape& shape : shapes_) {
      oriented_.push_back(is(shape, Shape::Kind::kBox));
      fixed_.push_back(place_oriented(shape, {}));
      cores_.push_back(rounded_core(shape));
    }
    for (const Pair& pair : pairs_) {
      if (cost_of(pair.test) == 0) continue;
      oriented_[index(pair.a)] = oriented_[index(pair.b)] = true;
    }
  }

  int colliding_pair(const std::vector<Pose<double>>& links) const override {
    thread_local std::vector<Placed> of_thread;  // allocates when it grows, not at every posture
    std::vector<Placed>& moving = of_thread;     // found once: each look-up takes time
    moving.resize(shapes_.size());
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const int link = shapes_[i].link;
      if (link > 0) place(shapes_[i], links[index(link)], oriented_[i] != 0, moving[i]);
    }
    // A loop, since Clang does not inline the test into std::find_if.
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Pair& pair = pairs_[i];
      const Placed& a = (pair.fixed_a ? fixed_ : moving)[index(pair.a)];
      const Placed& b = (pair.fixed_b ? fixed_ : moving)[index(pair.b)];
      if (collide(pair, a, b)) return static_cast<int>(i);
    }
    return -1;
  }

  bool nearest(const std::vector<Pose<double>>& links, int i,
               ClosestPoints& result) const override {
    const Pair& pair = pairs_[index(i)];
    if (pair.test == Test::kGrown) return false;
    if (pair.test == Test::kGjk) return nearest_by_gjk(links, pair, result);
    const Shape& a = shapes_[index(pair.box_first ? pair.b : pair.a)];  // a capsule
    const Shape& b = shapes_[index(pair.box_first ? pair.a : pair.b)];
    const Placed at_a = place_oriented(a, links[index(a.link)]);
    const Placed at_b = place_oriented(b, links[index(b.link)]);
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

  bool inner_bodies(int i, InnerBodyPair& result) const override {
    const Pair& pair = pairs_[index(i)];
    const double radius = inner_core(shapes_[index(pair.a)], result.a);
    result.reach = radius + inner_core(shapes_[index(pair.b)], result.b) + margin_;
    return true;
  }

  std::string pair_name(int i) const override {
    const Pair& pair = pairs_[index(i)];
    return shapes_[index(pair.a)].body + " and " + shapes_[index(pair.b)].body;
  }

  Collision made_of() const { return {shapes_, ignore_, margin_}; }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// First tests exclude most pairs that do not collide.
  bool collide(const Pair& pair, const Placed& at_a, const Placed& at_b) const {
    if ((at_a.pose.p - at_b.pose.p).squaredNorm() > pair.reach * pair.reach) return false;
    if (pair.test == Test::kCapsules) {
      return !separated_capsules(at_a, at_b, pair.radius) &&
             capsules_closer(at_a, at_b, pair.radius);
    }
    const std::size_t a = index(pair.a), b = index(pair.b);
    if (pair.test == Test::kCapsuleBox) {
      const Shape& box = shapes_[pair.box_first ? a : b];
      const CapsuleAtBox at(pair.box_first ? at_b : at_a, (pair.box_first ? at_a : at_b).pose,
                            pair.aligned);
      return !separated_from_box(at, box, pair.radius) &&
             segment_box_distance(at.centre - at.half_axis, at.centre + at.half_axis,
                                  box.half_sizes) < pair.radius;
    }
    if (pair.test == Test::kGjk) {
      return closer_than(cores_[a].core, at_a.pose, cores_[b].core, at_b.pose, apart(pair));
    }
    return pair.grown_a->intersects(at_a.pose, *pair.grown_b, at_b.pose);
  }

  /// The distance of the cores at which the shapes are as near as the margin.
  double apart(const Pair& pair) const {
    return cores_[index(pair.a)].rounding + cores_[index(pair.b)].rounding + margin_;
  }

  bool nearest_by_gjk(const std::vector<Pose<double>>& links, const Pair& pair,
                      ClosestPoints& result) const {
    const Shape &a = shapes_[index(pair.a)], &b = shapes_[index(pair.b)];
    const Between between =
        closest_points(cores_[index(pair.a)].core, links[index(a.link)] * a.placement,
                       cores_[index(pair.b)].core, links[index(b.link)] * b.placement);
    result = {between.distance() - apart(pair), a.link, b.link, between.on_a, between.on_b};
    return true;
  }

  std::vector<Shape> shapes_;
  std::vector<std::pair<std::string, std::string>> ignore_;
  std::vector<Placed> fixed_;   ///< the placed shapes of the base
  std::vector<char> oriented_;  ///< whether a shape's test needs its rotation
  std::vector<RoundedCore> cores_;
  std::vector<Pair> pairs_;
  double margin_;
};

}  // namespace

std::shared_ptr<const CollisionChecker> make_collision_checker(
    std::vector<Shape> shapes, const std::vector<std::pair<std::string, std::string>>& ignore,
    double margin) {
  const auto ignored = [&ignore](const Shape& a, const Shape& b) {
    return std::any_of(ignore.begin(), ignore.end(), [&](const auto& pair) {
      return (pair.first == a.body && pair.second == b.body) ||
             (pair.first == b.body && pair.second == a.body);
    });
  };
  for (Shape& shape : shapes) centre_hull(shape);
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
  return std::make_shared<ShapePairs>(Collision{std::move(shapes), ignore, margin},
                                      std::move(pairs));
}

std::optional<Collision> made_of(const CollisionChecker& checker) {
  const auto* const pairs = dynamic_cast<const ShapePairs*>(&checker);
  if (!pairs) return std::nullopt;
  return pairs->made_of();
}

}  // namespace maxwrench
