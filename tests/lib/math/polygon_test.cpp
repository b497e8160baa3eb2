#include "lib/math/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// The support of the convex hull of some points. `first_of_ties` chooses among equal ones.
Support support_of(const Points& points, bool first_of_ties = true) {
  return [points, first_of_ties](const Eigen::Vector2d& d) {
    std::pair<double, Eigen::Vector2d> best(-kInfinity, points[0]);
    for (const Eigen::Vector2d& p : points) {
      const double value = d.dot(p);
      if (value > best.first || (!first_of_ties && value == best.first)) best = {value, p};
    }
    return std::make_optional(best);
  };
}

/// The same vertices in the same order around, wherever they start.
void expect_same(const Points& actual, const Points& expected, double tolerance = 1e-12) {
  ASSERT_EQ(actual.size(), expected.size());
  const std::size_t n = actual.size();
  std::size_t shift = 0;
  while (shift < n && (actual[shift] - expected[0]).norm() > tolerance) ++shift;
  ASSERT_LT(shift, n) << "the first vertex is missing";
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_LE((actual[(i + shift) % n] - expected[i]).norm(), tolerance);
  }
}

double area(const Points& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d& q = p[(i + 1) % p.size()];
    twice += p[i].x() * q.y() - p[i].y() * q.x();
  }
  return twice / 2;
}

TEST(PolygonTest, KnownPolygons) {
  const Points square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Points triangle = {{-1, -1}, {3, 0}, {0.5, 2}};
  const Points diamond = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const Points octagon = {{2, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}};
  for (const Points& expected : {square, triangle, diamond, octagon}) {
    expect_same(polygon_from_support(support_of(expected)), expected);
    expect_same(polygon_from_support(support_of(expected, false)), expected);
    EXPECT_GT(area(expected), 0);  // counterclockwise
  }
}

TEST(PolygonTest, TiesInsideOfEdges) {
  // A support that answers with the middle of an edge where it can, as an interior point method.
  const Points square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Support middle = [](const Eigen::Vector2d& d) {
    const auto end = [](double d_i) { return d_i > 0 ? 1.0 : d_i < 0 ? 0.0 : 0.5; };
    const Eigen::Vector2d p(end(d.x()), end(d.y()));
    return std::make_optional(std::make_pair(d.dot(p), p));
  };
  expect_same(polygon_from_support(middle), square);
}

TEST(PolygonTest, RandomHulls) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    Points points;
    for (int i = 0; i < 3 + static_cast<int>(seed % 40); ++i) {
      points.emplace_back(1000 + 5 * random.normal(), 0.1 * random.normal());
    }
    const Points polygon = polygon_from_support(support_of(points));
    expect_same(polygon, convex_hull(points));
    // The support of the polygon is that of the set, in any direction.
    for (int k = 0; k < 64; ++k) {
      const double angle = 2 * M_PI * k / 64;
      const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
      EXPECT_NEAR(support_of(polygon)(d)->first, support_of(points)(d)->first, 1e-7);
    }
  }
}

TEST(PolygonTest, AsksOncePerEdgeAndVertex) {
  const Points octagon = {{2, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}};
  int questions = 0;
  const Support inner = support_of(octagon);
  polygon_from_support([&](const Eigen::Vector2d& d) {
    ++questions;
    return inner(d);
  });
  EXPECT_LE(questions, 2 * 8);
}

TEST(PolygonTest, DegenerateSets) {
  expect_same(polygon_from_support(support_of({{2, 3}})), {{2, 3}});
  const Points slanted = {{0, 0}, {2, 1}};
  const Points vertical = {{1, -1}, {1, 0}, {1, 4}};
  const Points horizontal = {{5, 2}, {1, 2}, {-3, 2}};
  for (const bool first : {true, false}) {
    EXPECT_EQ(polygon_from_support(support_of(slanted, first)).size(), 2u);
    EXPECT_EQ(polygon_from_support(support_of(vertical, first)).size(), 2u);
    EXPECT_EQ(polygon_from_support(support_of(horizontal, first)).size(), 2u);
  }
  expect_same(polygon_from_support(support_of(vertical)), {{1, -1}, {1, 4}});
  EXPECT_EQ(polygon_from_support(support_of({{0, 0}, {1, 1e-13}, {2, 0}})).size(), 2u);
}

TEST(PolygonTest, NoAnswerMeansNoVertices) {
  const Support half_plane = [](const Eigen::Vector2d& d) {
    return d.y() > 0 ? std::nullopt
                     : std::make_optional(std::make_pair(0.0, Eigen::Vector2d(0, 0)));
  };
  EXPECT_TRUE(polygon_from_support(half_plane).empty());
}

TEST(PolygonTest, InscribesACurve) {
  // The unit circle about (1, 2): with a sagitta of 1e-4 times the diameter an n-gon has an area of
  // pi (1 - (2/3) pi^2/n^2 ...), here within 1e-3.
  const Eigen::Vector2d centre(1, 2);
  const Points circle = polygon_from_support(
      [&](const Eigen::Vector2d& d) {
        return std::make_optional(std::make_pair(d.dot(centre) + 1, Eigen::Vector2d(centre + d)));
      },
      1e-4);
  EXPECT_NEAR(area(circle), M_PI, 1e-3);
  EXPECT_LT(circle.size(), 300u);
}

TEST(PolygonTest, ConvexHull) {
  expect_same(convex_hull({{0, 0}, {1, 0}, {0.5, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0, 0}}),
              {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {2, 2}}).size(), 2u);
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}}).size(), 1u);
  EXPECT_TRUE(convex_hull({}).empty());
}

}  // namespace
}  // namespace maxwrench
