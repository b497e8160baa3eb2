#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/math/gjk.h"
#include "maxwrench/task.h"
#include "problems/collision/collision.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Pose<double> random_pose(Random& random, double size) {
  return {random_rotation(random), random_vector(random, size)};
}

/// Random points, of which a part lies in a plane, on a line or twice at one place.
Points random_points(Random& random, int count, int degenerate) {
  Points points;
  Vector3d size(0.3, 0.3, 0.3);
  if (degenerate > 0) size[2] = 0;
  if (degenerate > 1) size[1] = 0;
  for (int i = 0; i < count; ++i) points.push_back(random_vector(random).cwiseProduct(size));
  points.push_back(points[0]);
  return points;
}

ConvexCore core_of_points(const Points& points) {
  ConvexCore core;
  core.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    core.points.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  }
  return core;
}

Points moved(const Points& points, const Pose<double>& pose) {
  Points result;
  for (const Vector3d& x : points) result.push_back(pose.R * x + pose.p);
  return result;
}

/// Distance of x from the triangle, by its plane if the foot is inside; the edges are left to the
/// caller.
double plane_distance(const Vector3d& x, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  if (n.norm() < 1e-9) return kInfinity;
  const Vector3d foot = x - n * n.dot(x - a) / n.squaredNorm();
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    if (n.dot((q - p).cross(foot - p)) < 0) return kInfinity;
  }
  return (x - foot).norm();
}

/// The distance of two hulls that do not intersect. The closest points are on an edge of each, or
/// on a face of one and a vertex of the other, and all edges and faces are among all pairs and
/// triples of points.
double exhaustive_distance(const Points& a, const Points& b) {
  double least = kInfinity;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k < b.size(); ++k) {
        for (std::size_t l = 0; l <= k; ++l) {
          least = std::min(least, segment_distance(a[i], a[j], b[k], b[l]));
        }
      }
    }
  }
  for (const auto& [faces, corners] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (std::size_t i = 0; i < faces->size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          for (const Vector3d& x : *corners) {
            least = std::min(least, plane_distance(x, (*faces)[i], (*faces)[j], (*faces)[k]));
          }
        }
      }
    }
  }
  return least;
}

/// The closest points prove a lower bound of the distance: the plane across them separates the
/// hulls by it. The exhaustive search is an upper bound, reached by some pair of features.
TEST(Gjk, FindsTheDistanceOfHulls) {
  Random random(1);
  int apart = 0;
  double worst = 0;
  for (int sample = 0; sample < samples(2000); ++sample) {
    const Points in_a = random_points(random, 9, sample % 3);
    const Points in_b = random_points(random, 9, sample / 3 % 3);
    const Pose<double> pose_a = random_pose(random, 0.6), pose_b = random_pose(random, 0.6);
    const ConvexCore core_a = core_of_points(in_a), core_b = core_of_points(in_b);
    const Between between = closest_points(core_a, pose_a, core_b, pose_b);
    const double distance = between.distance();
    if (distance == 0) continue;
    ++apart;
    const Vector3d n = (between.on_a - between.on_b) / distance;
    const Points a = moved(in_a, pose_a), b = moved(in_b, pose_b);
    double gap = kInfinity;
    for (const Vector3d& x : a) {
      for (const Vector3d& y : b) gap = std::min(gap, n.dot(x - y));
    }
    EXPECT_NEAR(gap, distance, 1e-9) << sample;
    const double expected = exhaustive_distance(a, b);
    worst = std::max(worst, std::abs(expected - distance));
    EXPECT_NEAR(distance, expected, 1e-9) << sample;
    for (const double off : {1e-9, 1e-4, 0.1}) {
      EXPECT_TRUE(closer_than(core_a, pose_a, core_b, pose_b, expected + off)) << sample;
      if (off > expected) continue;
      EXPECT_FALSE(closer_than(core_a, pose_a, core_b, pose_b, expected - off)) << sample;
    }
    EXPECT_FALSE(closer_than(core_a, pose_a, core_b, pose_b, 0)) << sample;
  }
  EXPECT_GT(apart, samples(1000));
  EXPECT_LT(worst, 1e-12);
}

/// Two hulls with a point in common, which is a random mean of the points of each.
TEST(Gjk, KnowsHullsThatIntersect) {
  Random random(2);
  for (int sample = 0; sample < samples(5000); ++sample) {
    const Points in_a = random_points(random, 12, 0);
    const Points in_b = random_points(random, 12, sample % 3);
    const auto mean = [&random](const Points& points) {
      Vector3d sum = Vector3d::Zero();
      double weights = 0;
      for (const Vector3d& x : points) {
        const double weight = 0.05 + random.uniform();
        sum += weight * x;
        weights += weight;
      }
      return Vector3d(sum / weights);
    };
    const Pose<double> pose_a = random_pose(random, 0.6);
    Pose<double> pose_b = random_pose(random, 0.6);
    pose_b.p += pose_a.R * mean(in_a) + pose_a.p - (pose_b.R * mean(in_b) + pose_b.p);
    const ConvexCore a = core_of_points(in_a), b = core_of_points(in_b);
    EXPECT_TRUE(closer_than(a, pose_a, b, pose_b, 0)) << sample;
    EXPECT_EQ(closest_points(a, pose_a, b, pose_b).distance(), 0) << sample;
  }
}

Shape hull_shape_of(const Points& points, double radius, int link) {
  Shape shape;
  shape.kind = Shape::Kind::kHull;
  shape.points = points;
  shape.radius = radius;
  shape.link = link;
  return shape;
}

/// The corners of a box, and a capsule's axis with its radius, are hulls. So all pairs of boxes and
/// capsules with a capsule have a second answer, from the formulas.
TEST(HullPairs, AgreeWithTheFormulasOfCapsulesAndBoxes) {
  Random random(3);
  int collisions = 0, tested = 0;
  for (int sample = 0; sample < samples(5000); ++sample) {
    Shape capsule;
    capsule.link = 1;
    capsule.radius = 0.05 + 0.1 * random.uniform();
    capsule.half_length = 0.3 * random.uniform();
    capsule.placement = random_pose(random, 0.2);
    Shape box;
    box.kind = Shape::Kind::kBox;
    box.link = 2;
    box.half_sizes = Vector3d(0.25, 0.25, 0.25) + random_vector(random, 0.1).cwiseMax(-0.2);
    box.placement = random_pose(random, 0.2);
    const Vector3d axis(0, 0, capsule.half_length);
    Shape capsule_hull = hull_shape_of({axis, -axis, axis, -axis}, capsule.radius, 1);
    capsule_hull.placement = capsule.placement;
    Points corners;
    for (int i = 0; i < 8; ++i) {
      corners.push_back(
          box.half_sizes.cwiseProduct(Vector3d(i % 2 * 2 - 1, i / 2 % 2 * 2 - 1, i / 4 * 2 - 1)));
    }
    Shape box_hull = hull_shape_of(corners, 0, 2);
    box_hull.placement = box.placement;
    const std::vector<Pose<double>> links = {
        {}, random_pose(random, 0.3), random_pose(random, 0.3)};
    const double margin = sample % 2 == 0 ? 0 : 0.03;
    const auto formula = make_collision_checker({capsule, box}, {}, margin);
    ClosestPoints known, found;
    ASSERT_TRUE(formula->nearest(links, 0, known));
    if (std::abs(known.clearance) < 1e-9) continue;  // either answer is right
    ++tested;
    collisions += formula->collides(links) ? 1 : 0;
    for (const auto& [a, b] : {std::pair(capsule, box_hull), std::pair(capsule_hull, box),
                               std::pair(capsule_hull, box_hull), std::pair(box_hull, capsule)}) {
      const auto checker = make_collision_checker({a, b}, {}, margin);
      EXPECT_EQ(checker->collides(links), formula->collides(links)) << sample;
      ASSERT_TRUE(checker->nearest(links, 0, found));
      EXPECT_NEAR(found.clearance, known.clearance, 1e-9) << sample;
      EXPECT_EQ(found.link_a, a.link);
      EXPECT_EQ(found.link_b, b.link);
      InnerBodyPair inner;
      ASSERT_TRUE(checker->inner_bodies(0, inner));
      EXPECT_EQ(inner.a.points.empty(), a.points.empty());
      EXPECT_EQ(inner.b.points.empty(), b.points.empty());
      EXPECT_EQ(inner.reach, a.radius + b.radius + margin);
    }
  }
  EXPECT_GT(collisions, tested / 10);
  EXPECT_LT(collisions, tested * 9 / 10);
}

/// Boxes along the same axes have parallel faces and edges, on which no closest point is unique.
/// The distance is that of the gaps along the axes.
TEST(HullPairs, AgreeWithTheGapsOfParallelBoxes) {
  Random random(6);
  const auto corners = [](const Vector3d& half) {
    Points points;
    for (int i = 0; i < 27; ++i) {  // with the middles of edges and faces
      points.push_back(half.cwiseProduct(Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
    }
    return points;
  };
  const auto tenths = [&random](double low, double high) {
    return Vector3d(Vector3d::NullaryExpr(
        [&](Eigen::Index) { return std::floor(random.uniform(low, high + 1)) / 10; }));
  };
  for (int sample = 0; sample < samples(5000); ++sample) {
    const Vector3d a = tenths(1, 4), b = tenths(1, 4);
    const Pose<double> turned = random_pose(random, 0.5);
    for (const bool exact : {true, false}) {  // along the world's axes, or turned together
      const Pose<double> pose_a = exact ? Pose<double>() : turned;
      Pose<double> pose_b = pose_a;
      const Vector3d offset = tenths(-10, 10);
      pose_b.p += pose_a.R * offset;
      const double distance = (offset.cwiseAbs() - a - b).cwiseMax(0).norm();
      const ConvexCore core_a = core_of_points(corners(a)), core_b = core_of_points(corners(b));
      const Between between = closest_points(core_a, pose_a, core_b, pose_b);
      EXPECT_NEAR(between.distance(), distance, 1e-12) << sample;
      EXPECT_TRUE(closer_than(core_a, pose_a, core_b, pose_b, distance + 1e-9)) << sample;
      if (distance > 1e-8) {
        EXPECT_FALSE(closer_than(core_a, pose_a, core_b, pose_b, distance - 1e-9)) << sample;
      }
    }
  }
}

/// A cylinder about z and a point x of radius r: the distance is that of (|x_xy|, z) from a
/// rectangle.
TEST(HullPairs, AgreeWithTheDistanceOfAPointFromACylinder) {
  Random random(4);
  for (int sample = 0; sample < samples(5000); ++sample) {
    Shape cylinder;
    cylinder.kind = Shape::Kind::kCylinder;
    cylinder.radius = 0.1;
    cylinder.half_length = 0.2;
    const Vector3d x = random_vector(random, 0.3);
    const double distance =
        std::hypot(std::max(x.head<2>().norm() - 0.1, 0.0), std::max(std::abs(x.z()) - 0.2, 0.0));
    if (distance < 1e-6) continue;
    const std::vector<Pose<double>> links = {{}, random_pose(random, 0.3)};
    cylinder.link = 1;
    for (const double off : {-1e-7, 1e-7}) {
      const Shape ball = hull_shape_of({x, x, x, x}, distance + off - 0.5e-7, 1);
      Shape on_base = ball;
      on_base.link = 0;
      on_base.placement = links[1];
      if (on_base.radius < 0) continue;
      const auto checker = make_collision_checker({on_base, cylinder}, {}, 0.5e-7);
      EXPECT_EQ(checker->collides(links), off > 0) << sample << " " << distance;
    }
  }
}

TEST(HullPairs, AreCheckedByFinalize) {
  Robot robot;
  robot.links.push_back({.name = "base"});
  const Points four = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto with = [&](const Points& points, double radius) {
    return finalize(robot, {.shapes = {hull_shape_of(points, radius, 0)}});
  };
  const char* points = "link[base].collision.geometry.hull.points";
  expect_rejected(points, [&] { with({four[0], four[1], four[2]}, 0); });
  expect_rejected(points, [&] { with({four[0], four[1], four[2], {0, 0, NAN}}, 0); });
  expect_rejected("link[base].collision.geometry.hull.radius", [&] { with(four, -1e-3); });
  const Robot good = with(four, 0.01);
  ASSERT_EQ(good.convex_bodies.size(), 1U);
  EXPECT_EQ(good.convex_bodies[0].points, four);  // its link and shape have the same axes
  EXPECT_EQ(good.convex_bodies[0].radius, 0.01);
}

TEST(HullPairs, AllocateNothing) {
  Random random(5);
  std::vector<Shape> shapes;
  std::vector<Pose<double>> links;
  for (int i = 0; i < 8; ++i) {
    shapes.push_back(hull_shape_of(random_points(random, 100, 0), 0.001, i));
    links.push_back(random_pose(random, 1));
  }
  const auto checker = make_collision_checker(shapes, {}, 0.01);
  ClosestPoints result;
  checker->collides(links);
  const long before = allocation_count();
  for (int sample = 0; sample < 100; ++sample) {
    for (Pose<double>& link : links) link.p = random_vector(random, 3);
    checker->collides(links);
    checker->nearest(links, sample % checker->pairs(), result);
  }
  if (kAllocationsAreCounted) {
    EXPECT_EQ(allocation_count(), before);
  }
}

}  // namespace
}  // namespace maxwrench
