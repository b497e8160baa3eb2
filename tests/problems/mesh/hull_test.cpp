#include "problems/mesh/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/math/distance.h"
#include "lib/math/random.h"
#include "problems/mesh/capsule.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// The distance of x from the hull of points, by Frank and Wolfe's method with exact line search
/// and away steps: it shares nothing with GJK. It is an upper bound.
double distance_upper_bound(const Points& points, const Vector3d& x) {
  std::vector<double> weights(points.size(), 0);
  weights[0] = 1;
  Vector3d y = points[0];
  for (int step = 0; step < 20000; ++step) {
    const Vector3d gradient = y - x;
    std::size_t toward = 0, away = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (gradient.dot(points[i]) < gradient.dot(points[toward])) toward = i;
      if (weights[i] > 0 &&
          (away == points.size() || gradient.dot(points[i]) > gradient.dot(points[away]))) {
        away = i;
      }
    }
    const Vector3d d = points[toward] - points[away];  // moves weight from one to the other
    const double slope = -gradient.dot(d);
    if (slope <= 1e-14 || toward == away) break;
    const double t = std::min(slope / d.squaredNorm(), weights[away]);
    weights[toward] += t;
    weights[away] -= t;
    y += t * d;
  }
  return (y - x).norm();
}

Points random_ball(Random& random, int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.push_back(random_vector(random).normalized().cwiseProduct(Vector3d(0.3, 0.1, 0.2)));
  }
  return points;
}

TEST(Hull, KeepsItsVerticesIfTheyAreFew) {
  Points cube;
  for (int i = 0; i < 27; ++i) cube.emplace_back(i % 3, i / 3 % 3, i / 9);  // and its inside
  const GrownHull hull = hull_of(cube);
  EXPECT_EQ(hull.vertices, 8);
  EXPECT_EQ(hull.points.size(), 8U);
  EXPECT_EQ(hull.radius, 0);
  for (const Vector3d& x : hull.points) {
    for (const double coordinate : x) EXPECT_TRUE(coordinate == 0 || coordinate == 2);
  }
}

TEST(Hull, SLOW_ContainsAllPointsWithFewVertices) {
  Random random(1);
  for (const int count : {65, 200, 800}) {
    if (kSanitized && count > 200) continue;
    const Points points = random_ball(random, count);
    const GrownHull hull = hull_of(points);
    EXPECT_EQ(hull.vertices, count);  // every point of an ellipsoid is a vertex
    EXPECT_EQ(hull.points.size(), 64U);
    double farthest = 0;
    for (const Vector3d& x : points) {
      farthest = std::max(farthest, distance_upper_bound(hull.points, x));
    }
    EXPECT_LE(farthest, hull.radius + 1e-7) << count;
    EXPECT_GE(farthest, hull.radius - 1e-7) << count;  // no larger than need be
    EXPECT_LT(hull.radius, 0.02);
  }
}

/// Points in a plane, on a line and at one place have no volume.
TEST(Hull, AcceptsPointsWithoutVolume) {
  Random random(2);
  const Eigen::Matrix3d R = random_rotation(random);
  Points square, line;
  for (int i = 0; i < 25; ++i) {
    square.emplace_back(R * Vector3d(i % 5, i / 5, 0));
    line.emplace_back(R.col(0) * i);
  }
  for (const auto& [points, corners] :
       {std::pair(square, 4), std::pair(line, 2), std::pair(Points{R.col(1)}, 1)}) {
    const GrownHull hull = hull_of(points);
    EXPECT_EQ(hull.vertices, corners);
    EXPECT_GE(hull.points.size(), 4U);
    EXPECT_EQ(hull.radius, 0);
    for (const Vector3d& x : points) EXPECT_LT(distance_upper_bound(hull.points, x), 1e-6);
  }
}

TEST(Capsule, ContainsThePoints) {
  Random random(3);
  for (int sample = 0; sample < 30; ++sample) {
    Points points = random_ball(random, sample < 5 ? sample + 1 : 100);
    const Pose<double> pose{random_rotation(random), random_vector(random)};
    for (Vector3d& x : points) x = pose.R * x + pose.p;
    const Shape capsule = capsule_around(points);
    const Vector3d half = capsule.half_length * capsule.placement.R.col(2);
    const Vector3d& p = capsule.placement.p;
    for (const Vector3d& x : points) {
      EXPECT_LE(segment_distance(p - half, p + half, x, x), capsule.radius + 1e-15);
    }
  }
}

/// The points are those of a capsule, so the best one has its volume or, as some are missing, less.
TEST(Capsule, IsAsSmallAsTheOneThePointsAreFrom) {
  Random random(4);
  const Pose<double> pose{random_rotation(random), random_vector(random)};
  Points points;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d x = 0.1 * random_vector(random).normalized();
    points.emplace_back(pose.R * (x + Vector3d(0, 0, x.z() > 0 ? 0.3 : -0.3)) + pose.p);
  }
  const Shape capsule = capsule_around(points);
  EXPECT_NEAR(capsule.radius, 0.1, 0.002);
  EXPECT_NEAR(capsule.half_length, 0.3, 0.004);
  EXPECT_LT((capsule.placement.p - pose.p).norm(), 0.004);
  EXPECT_GT(std::abs(capsule.placement.R.col(2).dot(pose.R.col(2))), 0.9999);
}

}  // namespace
}  // namespace maxwrench
