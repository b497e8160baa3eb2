#include "maxwrench/zonotope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

Zonotope random_zonotope(Random& random, int n, int m) {
  const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(
      n, m, [&](Eigen::Index, Eigen::Index) { return random.normal(); });
  const Eigen::VectorXd low =
      Eigen::VectorXd::NullaryExpr(m, [&] { return random.uniform(-3, -1); });
  const Eigen::VectorXd high =
      Eigen::VectorXd::NullaryExpr(m, [&] { return random.uniform(1, 3); });
  return make_zonotope(B, low, high);
}

double violation(const Zonotope& z, const Eigen::VectorXd& tau) {
  const Eigen::VectorXd value = z.N.transpose() * tau;
  return std::max((value - z.b_max).maxCoeff(), (z.b_min - value).maxCoeff());
}

TEST(Zonotope, GeneralPositionHasAsManyFacetPairsAsSubsets) {
  // Generators in general position: every subset of n - 1 of m spans a facet pair, C(6, 2) = 15.
  Random random(1);
  EXPECT_EQ(random_zonotope(random, 3, 6).facet_pairs(), 15);
}

TEST(Zonotope, FacetsContainAllPointsAndAreTouched) {
  Random random(2);
  for (int sample = 0; sample < 20; ++sample) {
    const Zonotope z = random_zonotope(random, 4, 7);
    for (int i = 0; i < 100; ++i) {
      Eigen::VectorXd u(7);
      for (int j = 0; j < 7; ++j) u[j] = random.uniform(z.u_min[j], z.u_max[j]);
      EXPECT_LE(violation(z, z.B * u), 1e-12);
    }
    for (int f = 0; f < z.facet_pairs(); ++f) {
      // The vertex that is extreme along the normal attains the bound.
      Eigen::VectorXd u(7);
      for (int j = 0; j < 7; ++j) u[j] = z.N.col(f).dot(z.B.col(j)) > 0 ? z.u_max[j] : z.u_min[j];
      EXPECT_NEAR(z.N.col(f).dot(z.B * u), z.b_max[f], 1e-10);
      EXPECT_GT(violation(z, z.B * u + 1e-3 * z.N.col(f)), 9e-4);
    }
  }
}

TEST(Zonotope, JointsAreTheirOwnBlocks) {
  // Two thrusters on {x, y} and a joint: the parallelogram has two pairs, the joint one.
  Eigen::MatrixXd B(3, 3);
  B << 1, 1, 0, 1, -1, 0, 0, 0, 1;
  const Zonotope z = make_zonotope(B, Eigen::Vector3d(-1, -1, -5), Eigen::Vector3d(1, 2, 5));
  EXPECT_EQ(z.facet_pairs(), 3);
  EXPECT_TRUE(z.full_row_rank());
  EXPECT_LT((z.B * z.B_pinv - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

/// The block of row 1 lies between the rows of the block of rows 0 and 2.
TEST(Zonotope, NormalsAreZeroOutsideTheirRows) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(5, 6);
  B(1, 1) = 2;
  B.row(0) << 1, 0, 1, 0, 0, 1;
  B.row(2) << 1, 0, -1, 0, 0, 2;
  B(3, 3) = B(4, 4) = 1;
  const Eigen::VectorXd limit = Eigen::VectorXd::Ones(6);
  const Zonotope z = make_zonotope(B, -limit, limit);
  ASSERT_EQ(z.facet_pairs(), 6);  // 3 of rows 0 and 2, and one of each other row
  ASSERT_EQ(z.N_begin.size(), 6);
  ASSERT_EQ(z.N_end.size(), 6);
  EXPECT_TRUE(std::is_sorted(z.N_begin.begin(), z.N_begin.end()));
  EXPECT_TRUE(std::is_sorted(z.N_end.begin(), z.N_end.end()));
  for (int j = 0; j < z.facet_pairs(); ++j) {
    EXPECT_TRUE(z.N.col(j).head(z.N_begin[j]).isZero(0)) << j;
    EXPECT_TRUE(z.N.col(j).tail(5 - z.N_end[j]).isZero(0)) << j;
    EXPECT_LE(z.N_end[j], 5);
  }
  EXPECT_GT(z.N_begin.back(), 0);
  EXPECT_LT(z.N_end.front(), 5);
}

TEST(Zonotope, UnreachedDirectionsBecomePairsOfZeroWidth) {
  // One thruster along (1, 1) in the plane: tau must be a multiple of it.
  Eigen::MatrixXd B(2, 1);
  B << 1, 1;
  const Zonotope z = make_zonotope(B, Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Ones(1));
  EXPECT_EQ(z.rank, 1);
  EXPECT_FALSE(z.full_row_rank());
  EXPECT_EQ(z.facet_pairs(), 2);
  EXPECT_LE(violation(z, Eigen::Vector2d(1, 1)), 1e-15);
  EXPECT_GT(violation(z, Eigen::Vector2d(1, 0.9)), 0.05);
  // A row without any actuator is such a direction too.
  const Zonotope idle = make_zonotope(Eigen::MatrixXd::Zero(2, 1), Eigen::VectorXd::Constant(1, -1),
                                      Eigen::VectorXd::Ones(1));
  EXPECT_GT(violation(idle, Eigen::Vector2d(0, 0.1)), 0.05);
}

TEST(Zonotope, TooManySubsetsMeanNoFacets) {
  Random random(3);
  const Zonotope z = random_zonotope(random, 6, 30);  // C(30, 5) = 142,506
  EXPECT_FALSE(z.has_facets);
  EXPECT_EQ(z.facet_pairs(), 0);
}

TEST(Zonotope, RejectsCrossingLimits) {
  EXPECT_THROW(make_zonotope(Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Ones(1),
                             Eigen::VectorXd::Zero(1)),
               std::invalid_argument);
  EXPECT_THROW(make_zonotope(Eigen::MatrixXd::Ones(1, 2), Eigen::VectorXd::Zero(1),
                             Eigen::VectorXd::Ones(1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
