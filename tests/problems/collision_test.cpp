#include "problems/collision/collision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "lib/math/distance.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "problems/collision/shapes.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;

/// Random poses and sizes; a part of the poses is aligned with the axes.
class Sampler {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Vector3d point(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Pose<double> pose(double size) {
    std::normal_distribution<double> normal;
    Eigen::Quaterniond q(normal(generator_), normal(generator_), normal(generator_),
                         normal(generator_));
    if (uniform(0, 1) < 0.25) q = Eigen::Quaterniond(1, uniform(0, 1) < 0.5 ? 1 : 0, 0, 0);
    return {q.normalized().toRotationMatrix(), point(size)};
  }
  Shape shape(Shape::Kind kind) {
    Shape shape;
    shape.kind = kind;
    shape.radius = uniform(0.01, 0.2);
    shape.half_length = uniform(0.01, 0.4);
    shape.half_sizes = Vector3d(0.22, 0.22, 0.22) + point(0.2);
    return shape;
  }

 private:
  std::mt19937 generator_{1};
};

/// Distance of a point in shape axes from the shape, 0 inside. For a capsule, from its axis.
double point_distance(const Shape& shape, const Vector3d& x) {
  const double along = std::max(std::abs(x.z()) - shape.half_length, 0.0);
  const double across = x.head<2>().norm();
  if (shape.kind == Shape::Kind::kCapsule) return std::hypot(along, across);
  if (shape.kind == Shape::Kind::kCylinder) {
    return std::hypot(along, std::max(across - shape.radius, 0.0));
  }
  return (x.cwiseAbs() - shape.half_sizes).cwiseMax(0.0).norm();
}

/// Of a convex function on [-1, 1], by golden section.
double minimum(const std::function<double(double)>& f) {
  double low = -1, high = 1;
  for (int i = 0; i < 90; ++i) {
    const double a = high - (high - low) * 0.6180339887498949;
    const double b = low + (high - low) * 0.6180339887498949;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return std::min({f(low), f(-1), f(1)});
}

/// A capsule against any shape: the distance from a convex shape is convex along the axis.
double capsule_distance(const Shape& capsule, const Pose<double>& pose, const Shape& other,
                        const Pose<double>& other_pose) {
  const Pose<double> local = other_pose.inverse() * pose;
  const double axis = minimum([&](double s) {
    return point_distance(other, local.p + s * capsule.half_length * local.R.col(2));
  });
  return axis - capsule.radius - (other.kind == Shape::Kind::kCapsule ? other.radius : 0);
}

/// The checker's decision for a single pair.
bool closer_than(Shape a, const Pose<double>& pose_a, Shape b, const Pose<double>& pose_b,
                 double margin) {
  a.link = 1;
  b.link = 2;
  return make_collision_checker({a, b}, {}, margin)->collides({{}, pose_a, pose_b});
}

class CapsuleAgainst : public testing::TestWithParam<Shape::Kind> {};

TEST_P(CapsuleAgainst, AgreesWithAnIndependentDistance) {
  Sampler sampler;
  int close = 0;
  for (int i = 0; i < samples(20000); ++i) {
    const Shape capsule = sampler.shape(Shape::Kind::kCapsule);
    const Shape other = sampler.shape(GetParam());
    const Pose<double> a = sampler.pose(0.7), b = sampler.pose(0.7);
    const double margin = i % 2 == 0 ? 0 : 0.05;
    const double distance = capsule_distance(capsule, a, other, b);
    if (std::abs(distance - margin) < 1e-7) continue;  // either answer is right
    close += distance < margin ? 1 : 0;
    ASSERT_EQ(closer_than(capsule, a, other, b, margin), distance < margin) << i << " " << distance;
    ASSERT_EQ(closer_than(other, b, capsule, a, margin), distance < margin) << i << " " << distance;
  }
  EXPECT_GT(close, samples(1000));
}

INSTANTIATE_TEST_SUITE_P(Shapes, CapsuleAgainst,
                         testing::Values(Shape::Kind::kCapsule, Shape::Kind::kBox,
                                         Shape::Kind::kCylinder));

/// A random point of a box or cylinder, mostly on its surface.
Vector3d sample(const Shape& shape, Sampler& sampler) {
  Vector3d x = 2 * sampler.point(1);
  x = x.cwiseMax(-1).cwiseMin(1);  // faces, edges and corners get their share
  if (shape.kind == Shape::Kind::kBox) return x.cwiseProduct(shape.half_sizes);
  const double angle = std::numbers::pi * x.y();
  const double radius = shape.radius * std::abs(x.x());
  return {radius * std::cos(angle), radius * std::sin(angle), x.z() * shape.half_length};
}

/// The projections onto an axis are disjoint by more than `gap`: proof that no two points are
/// nearer than that.
bool separated(const Shape& a, const Pose<double>& pose_a, const Shape& b,
               const Pose<double>& pose_b, const Vector3d& axis, double gap) {
  const auto support = [&axis](const Shape& shape, const Pose<double>& pose) {
    const Vector3d n = pose.R.transpose() * axis;
    if (shape.kind == Shape::Kind::kBox) return n.cwiseAbs().dot(shape.half_sizes);
    return std::abs(n.z()) * shape.half_length + n.head<2>().norm() * shape.radius;
  };
  return std::abs(axis.dot(pose_a.p - pose_b.p)) > support(a, pose_a) + support(b, pose_b) + gap;
}

/// Boxes and cylinders, both ways: points of one that lie within the margin of the other prove a
/// collision; a separating axis beyond the grown margin proves that there is none.
TEST(BoxesAndCylinders, SLOW_AgreeWithSampledPointsAndSeparatingAxes) {
  using enum Shape::Kind;
  Sampler sampler;
  int collisions = 0, separations = 0;
  for (int i = 0; i < 3000; ++i) {
    const Shape a = sampler.shape(i % 3 == 0 ? kCylinder : kBox);
    const Shape b = sampler.shape(i % 3 == 2 ? kBox : kCylinder);
    const Pose<double> pose_a = sampler.pose(0.6), pose_b = sampler.pose(0.6);
    const double margin = i % 2 == 0 ? 0 : 0.04;
    const bool answer = closer_than(a, pose_a, b, pose_b, margin);
    const Pose<double> a_in_b = pose_b.inverse() * pose_a;
    for (int k = 0; k < 300; ++k) {
      const Vector3d x = a_in_b.R * sample(a, sampler) + a_in_b.p;
      const double distance = point_distance(b, x);
      if (distance > 0 && distance >= margin - 1e-9) continue;
      ASSERT_TRUE(answer) << i;
      ++collisions;
      break;
    }
    for (int k = 0; k < 300; ++k) {
      const Vector3d axis = k == 0 ? Vector3d((pose_a.p - pose_b.p).normalized())
                                   : Vector3d(sampler.point(1).normalized());
      if (!separated(a, pose_a, b, pose_b, axis, std::sqrt(3.0) * margin + 1e-9)) continue;
      ASSERT_FALSE(answer) << i;
      ++separations;
      break;
    }
  }
  EXPECT_GT(collisions, 300);
  EXPECT_GT(separations, 300);
}

TEST(SegmentDistance, KnownValues) {
  const Vector3d o(0, 0, 0), x(1, 0, 0), z(0, 0, 1);
  EXPECT_EQ(segment_distance(o, x, o, x), 0);                                    // the same
  EXPECT_EQ(segment_distance(o, x, z, x + z), 1);                                // parallel
  EXPECT_EQ(segment_distance(o, x, 3 * x, 4 * x), 2);                            // in line
  EXPECT_EQ(segment_distance(o, o, z, z), 1);                                    // points
  EXPECT_EQ(segment_distance(-x, x, Vector3d(0, -1, 2), Vector3d(0, 1, 2)), 2);  // skew
  EXPECT_EQ(segment_box_distance(-2 * x, 2 * x, Vector3d(1, 1, 1)), 0);          // through
  EXPECT_EQ(segment_box_distance(3 * x, 5 * x, Vector3d(1, 1, 1)), 2);
  EXPECT_EQ(segment_box_distance(3 * x, 3 * x, Vector3d(1, 1, 1)), 2);
  // The line x + y = 4 passes the edge (1, 1) at sqrt(2).
  EXPECT_DOUBLE_EQ(segment_box_distance({4, 0, 0}, {0, 4, 0}, Vector3d(1, 1, 1)), std::sqrt(2.0));
}

Shape ball(const char* body, int link, double x) {
  Shape shape;
  shape.body = body;
  shape.link = link;
  shape.radius = 0.1;
  shape.placement.p.x() = x;
  return shape;
}

TEST(CollisionChecker, SkipsPairsOnOneLinkAndIgnoredBodies) {
  // `tool` is welded to `arm`: one link, two bodies.
  const std::vector<Shape> shapes = {ball("hull", 0, 0), ball("arm", 1, 0), ball("tool", 1, 1)};
  const std::vector<Pose<double>> together(2);
  std::vector<Pose<double>> apart(2);
  apart[1].p.y() = 0.3;
  const auto all = make_collision_checker(shapes, {}, 0);
  EXPECT_EQ(all->pairs(), 2);
  EXPECT_EQ(all->colliding_pair(apart), -1);
  EXPECT_EQ(all->pair_name(all->colliding_pair(together)), "hull and arm");  // the first of both
  EXPECT_TRUE(all->collides(together));
  EXPECT_FALSE(all->collides(apart));
  EXPECT_TRUE(make_collision_checker(shapes, {}, 0.11)->collides(apart));  // gap 0.1
  EXPECT_FALSE(make_collision_checker(shapes, {}, 0.09)->collides(apart));
  const auto some = make_collision_checker(shapes, {{"arm", "hull"}}, 0);
  EXPECT_EQ(some->pairs(), 1);
  EXPECT_FALSE(some->collides(together));
  EXPECT_EQ(make_collision_checker(shapes, {{"arm", "hull"}, {"hull", "tool"}}, 0), nullptr);
}

/// Shapes of all kinds: where some point of one core is within reach of the other, they collide.
TEST(CollisionChecker, KnowsCoresThatCollide) {
  Sampler sampler;
  using Kind = Shape::Kind;
  int within = 0;
  for (int sample = 0; sample < 3000; ++sample) {
    constexpr std::array kKinds = {Kind::kBox, Kind::kCapsule, Kind::kCylinder};
    std::vector<Shape> shapes;
    for (const int link : {0, 1}) {
      shapes.push_back(
          sampler.shape(kKinds[static_cast<std::size_t>(sample / (2 * link + 1) % 3)]));
      shapes.back().link = link;
      shapes.back().placement = sampler.pose(0.1);
    }
    const auto checker = make_collision_checker(shapes, {}, 0.01);
    const std::vector<Pose<double>> links = {{}, sampler.pose(0.5)};
    InnerBodyPair pair;
    ASSERT_TRUE(checker->inner_bodies(0, pair));
    const Pose<double> a = links[static_cast<std::size_t>(pair.a.link)] * pair.a.placement;
    const Pose<double> b = links[static_cast<std::size_t>(pair.b.link)] * pair.b.placement;
    const Vector3d in_a = sampler.point(1).cwiseProduct(pair.a.half_sizes);
    const Pose<double> into = b.inverse() * a;
    const Vector3d x = into.R * in_a + into.p;
    const double apart = (x.cwiseAbs() - pair.b.half_sizes).cwiseMax(0).norm();
    if (apart > pair.reach - 1e-6) continue;
    ++within;
    EXPECT_TRUE(checker->collides(links)) << sample;
  }
  EXPECT_GT(within, 300);
}

/// Along every direction a solid reaches as far as its shape: |h|'|R'd| for a box, half length
/// |z'd| plus the radius for a capsule, plus its share across the axis for a cylinder, less what a
/// prism of 32 faces misses.
TEST(ConvexBody, ReachesAsFarAsItsShape) {
  Sampler sampler;
  for (const auto kind : {Shape::Kind::kBox, Shape::Kind::kCapsule, Shape::Kind::kCylinder}) {
    for (int i = 0; i < 100; ++i) {
      Shape shape;
      shape.kind = kind;
      shape.placement = sampler.pose(1);
      shape.radius = 0.2;
      shape.half_length = 0.5;
      shape.half_sizes = {0.1, 0.2, 0.3};
      const ConvexBody solid = to_convex_body(shape);
      const Vector3d d = sampler.pose(1).R.col(0), local = shape.placement.R.transpose() * d;
      double reach = -1e9;
      for (const Vector3d& p : solid.points) {
        reach = std::max(reach, d.dot(p - shape.placement.p) + solid.radius);
      }
      double expected = 0.5 * std::abs(local.z()) + 0.2;
      if (kind == Shape::Kind::kBox) expected = shape.half_sizes.dot(local.cwiseAbs());
      if (kind == Shape::Kind::kCylinder) {
        expected = 0.5 * std::abs(local.z()) + 0.2 * local.head<2>().norm();
      }
      EXPECT_LE(reach, expected + 1e-12);
      EXPECT_GE(reach, expected - 0.2 * (1 - std::cos(std::numbers::pi / 32)) - 1e-12);
    }
  }
}

/// Both joints at -60 degrees bend the arm back: link 2 runs from the elbow at
/// (0.3, 0.1) + 0.1 (cos 60, -sin 60) = (0.35, 0.013) along (cos 120, -sin 120) to (0.3, -0.073), a
/// point of the hull's front face x = 0.3.
TEST(PlanarForce, ArmThatIsBentBackCollides) {
  const Problem problem = load_problem("planar/force");
  PostureEvaluator checked(problem), unchecked(problem, false);
  const Eigen::Vector2d bent = problem.theta_r_min;
  EXPECT_EQ(checked.evaluate(bent).status, Status::kInvalidPosture);
  EXPECT_EQ(unchecked.evaluate(bent).status, Status::kValid);
  // The optima of the three measures are free.
  for (const Eigen::Vector2d& theta_r :
       {Eigen::Vector2d(-0.8626, 1.0471), Eigen::Vector2d(-0.8436, 1.0471),
        Eigen::Vector2d(0.278, -0.104)}) {
    EXPECT_EQ(checked.evaluate(theta_r).status, Status::kValid);
  }
}

}  // namespace
}  // namespace maxwrench
