#include "lib/math/nearest_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/math/polygon.h"
#include "lib/math/random.h"

namespace maxwrench {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

/// The nearest edge of the hull of some points, and the number of questions.
int ask_about(const Corners& points, NearestEdge& edge) {
  int questions = 0;
  for (edge.start(); edge.asks(); ++questions) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (edge.direction().dot(points[i]) > edge.direction().dot(points[best])) best = i;
    }
    edge.answer(edge.direction().dot(points[best]), points[best]);
    if (questions > 1000) break;
  }
  return questions;
}

TEST(NearestEdge, OfKnownPolygons) {
  NearestEdge edge;
  ask_about({{3, -2}, {3, 2}, {-1, 2}, {-1, -2}}, edge);  // its left side
  EXPECT_DOUBLE_EQ(edge.value(), 1);
  EXPECT_LT((edge.normal() - Eigen::Vector2d(-1, 0)).norm(), 1e-15);
  ask_about({{2, 0}, {0, 2}, {-2, 0}, {0, -1}}, edge);  // x + 2 y = -2 or its mirror image
  EXPECT_NEAR(edge.value(), 2 / std::sqrt(5), 1e-15);
  EXPECT_NEAR(edge.normal().y(), -2 / std::sqrt(5), 1e-15);
}

/// What leaves out the origin has a negative value, also a segment or a point. Those through the
/// origin have the value 0.
TEST(NearestEdge, OfSetsWithoutTheOriginOrWithoutAnArea) {
  NearestEdge edge;
  for (const Corners& outside :
       {Corners{{1, 1}, {2, 1}, {1, 3}}, Corners{{1, 1}, {2, 2}}, Corners{{0, 1}, {0, 4}},
        Corners{{3, -1}}, Corners{{1, 2}, {2, 1}}}) {
    ask_about(outside, edge);
    EXPECT_LT(edge.value(), -0.1);
  }
  for (const Corners& through : {Corners{{-1, -1}, {2, 2}}, Corners{{0, 0}},
                                 Corners{{0, -1}, {0, 4}}, Corners{{0, 0}, {1, 3}}}) {
    ask_about(through, edge);
    EXPECT_NEAR(edge.value(), 0, 1e-15);
  }
}

/// Hulls of random points, against all edges of the hull.
TEST(NearestEdge, IsThatOfAllEdges) {
  NearestEdge edge;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    Corners points;
    for (int i = 0; i < 3 + static_cast<int>(seed % 60); ++i) {
      points.emplace_back(3 * random.normal() + 1, random.normal());
    }
    const Corners hull = convex_hull(points);
    double least = kInfinity;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Eigen::Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
      least = std::min(least, Eigen::Vector2d(along.y(), -along.x()).normalized().dot(hull[i]));
    }
    const int questions = ask_about(points, edge);
    EXPECT_LE(questions, 2 * static_cast<int>(hull.size()) + 4);
    if (least > 0) {
      EXPECT_NEAR(edge.value(), least, 1e-12);
    } else {
      EXPECT_LE(edge.value(), 0);
    }
  }
}

/// A regular polygon of 10,000 corners: few of its edges are asked for if the origin is off centre.
TEST(NearestEdge, AsksForFewEdges) {
  Corners points;
  for (int i = 0; i < 10'000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 10'000;
    points.emplace_back(0.5 + std::cos(angle), std::sin(angle));
  }
  NearestEdge edge;
  EXPECT_LT(ask_about(points, edge), 60);
  EXPECT_NEAR(edge.value(), 0.5, 1e-7);
}

}  // namespace
}  // namespace maxwrench
