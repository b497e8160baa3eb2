#include "view/engine/wrapped_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

Eigen::MatrixXd normal_numbers(int rows, int columns, Random& random) {
  Eigen::MatrixXd numbers(rows, columns);
  for (double& x : numbers.reshaped()) x = random.normal();
  return numbers;
}

/// All 2^m sums of columns of B: its hull has few facets, each with many of these points.
Eigen::MatrixXd sums_of_columns(const Eigen::MatrixXd& B) {
  const auto m = static_cast<int>(B.cols());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(B.rows(), 1 << m);
  for (int i = 0; i < sums.cols(); ++i) {
    for (int k = 0; k < m; ++k) {
      if ((i >> k & 1) != 0) sums.col(i) += B.col(k);
    }
  }
  return sums;
}

/// The facets support the points, their vertices are on them, and each facet that Qhull finds is
/// one of them.
void expect_hull_of(const Eigen::MatrixXd& points, const std::string& what) {
  const Hull hull = wrapped_hull(points);
  ASSERT_FALSE(hull.facets.empty()) << what;
  for (const HullFacet& facet : hull.facets) {
    const double offset = (facet.normal.transpose() * points).maxCoeff();
    EXPECT_NEAR(facet.normal.norm(), 1, 1e-12) << what;
    EXPECT_GE(static_cast<Eigen::Index>(facet.vertices.size()), points.rows()) << what;
    for (const int i : facet.vertices) {
      EXPECT_NEAR(facet.normal.dot(points.col(i)), offset, 1e-8) << what;
    }
  }
  for (const HullFacet& facet : quick_hull(points).facets) {
    const bool found = std::any_of(
        hull.facets.begin(), hull.facets.end(),
        [&](const HullFacet& own) { return (own.normal - facet.normal).norm() < 1e-6; });
    EXPECT_TRUE(found) << what << ": no facet along " << facet.normal.transpose();
  }
  if (points.rows() == 2) {
    EXPECT_EQ(hull.facets.size(), hull.vertices.size()) << what;
    return;
  }
  // Euler: each edge is shared by two facets, and a facet has as many edges as vertices.
  std::size_t edges = 0;
  for (const HullFacet& facet : hull.facets) edges += facet.vertices.size();
  EXPECT_EQ(hull.vertices.size() + hull.facets.size(), edges / 2 + 2) << what;
}

TEST(WrappedHull, IsThatOfQhull) {
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const int d = 2 + trial % 2, m = 3 + trial % 6;
    const std::string what = "trial " + std::to_string(trial);
    expect_hull_of(normal_numbers(d, 10 * m, random), what + ", points");
    expect_hull_of(sums_of_columns(normal_numbers(d, m, random)), what + ", sums");
  }
}

/// Many points at one place, on one line and on one plane.
TEST(WrappedHull, IsThatOfGrids) {
  Eigen::MatrixXd grid(3, 64);
  for (int i = 0; i < 64; ++i) grid.col(i) = Eigen::Vector3d(i % 4, i / 4 % 4, i / 16);
  const Hull cube = wrapped_hull(grid);
  EXPECT_EQ(cube.facets.size(), 6U);
  EXPECT_EQ(cube.vertices.size(), 8U);
  Eigen::MatrixXd twice(3, 128);
  twice << grid, grid;
  EXPECT_EQ(wrapped_hull(twice).vertices.size(), 8U);
  Random random(4);
  // Rounding must not make corners of points on an edge.
  for (int trial = 0; trial < 40; ++trial) {
    const Hull near = wrapped_hull(twice + 1e-14 * normal_numbers(3, 128, random));
    EXPECT_EQ(near.facets.size(), 6U);
    EXPECT_EQ(near.vertices.size(), 8U);
    const Hull square = wrapped_hull((twice + 1e-14 * normal_numbers(3, 128, random)).topRows<2>());
    EXPECT_EQ(square.facets.size(), 4U);
  }
  for (int trial = 0; trial < 40; ++trial) {
    Eigen::MatrixXd B = normal_numbers(3, 4 + trial % 4, random).array().round();
    B.leftCols<3>() += 4 * Eigen::Matrix3d::Identity();  // not flat
    expect_hull_of(sums_of_columns(B), "trial " + std::to_string(trial));
  }
}

TEST(WrappedHull, IsEmptyWithoutVolume) {
  Random random(5);
  Eigen::MatrixXd flat = normal_numbers(3, 20, random);
  flat.row(2) = flat.row(0) + flat.row(1);
  EXPECT_TRUE(wrapped_hull(flat).facets.empty());
  Eigen::MatrixXd line = normal_numbers(3, 1, random) * normal_numbers(1, 9, random);
  EXPECT_TRUE(wrapped_hull(line).facets.empty());
  EXPECT_TRUE(wrapped_hull(line.topRows<2>()).facets.empty());
  EXPECT_TRUE(wrapped_hull(Eigen::MatrixXd::Ones(3, 9)).facets.empty());
  EXPECT_TRUE(wrapped_hull(Eigen::MatrixXd::Identity(3, 3)).facets.empty());
}

}  // namespace
}  // namespace maxwrench
