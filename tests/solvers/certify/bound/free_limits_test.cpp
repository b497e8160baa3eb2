#include "solvers/certify/bound/free_limits.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Zonotope own_motors(const Eigen::VectorXd& most) {
  return make_zonotope(Eigen::MatrixXd::Identity(most.size(), most.size()), -most, most);
}

/// With |u_1| <= 1, |u_2| <= 3, t (2 +- 0.5) = u_1 and h (4 +- 1) = u_2: |t| <= 1/1.5, |h| <= 1.
TEST(FreeLimits, AreThoseOfIndependentRows) {
  const Zonotope set = own_motors(Eigen::Vector2d(1, 3));
  const Eigen::Vector2d tau(0, 0);
  const Eigen::Matrix2d A = Eigen::Vector2d(2, 4).asDiagonal();
  Eigen::MatrixXd off = Eigen::MatrixXd::Zero(2, 3);
  off(0, 1) = 0.5;
  off(1, 2) = 1;
  FreeLimits limits(set, Eigen::MatrixXd::Constant(2, 3, 10));
  ASSERT_TRUE(limits.find(tau, A, off, kInfinity));
  EXPECT_NEAR(limits.Z()[0], 1 / 1.5, 1e-4);
  EXPECT_NEAR(limits.Z()[1], 1, 1e-4);
  EXPECT_GE(limits.Z()[0], 1 / 1.5);
  EXPECT_GE(limits.Z()[1], 1);
}

/// A box that may have a row without a lever along t limits h only if t is limited elsewhere.
TEST(FreeLimits, NeedALeverOrALimitOfTheValue) {
  const Zonotope set = own_motors(Eigen::Vector2d(1, 3));
  const Eigen::Vector2d tau(0, 0);
  const Eigen::Matrix2d A = Eigen::Vector2d(2, 4).asDiagonal();
  Eigen::MatrixXd off = Eigen::MatrixXd::Zero(2, 3);
  off(0, 1) = 2;
  FreeLimits limits(set, Eigen::MatrixXd::Constant(2, 3, 10));
  EXPECT_FALSE(limits.find(tau, A, off, kInfinity));
  ASSERT_TRUE(limits.find(tau, A, off, 5));
  EXPECT_EQ(limits.Z()[0], 5);
  EXPECT_NEAR(limits.Z()[1], 0.75, 1e-4);
  off(1, 2) = 4;
  EXPECT_FALSE(limits.find(tau, A, off, 5));
  EXPECT_FALSE(limits.find(tau, Eigen::Matrix2d::Zero(), off, 5));
}

/// Whatever solves the balance in the box is within the limits, and so is what is left of h.
TEST(FreeLimits, HoldWhateverSolvesTheBalance) {
  constexpr Eigen::Index n = 5, k = 2;
  Random random(1);
  const auto any = [&] { return random.uniform(-1, 1); };
  int seen = 0, found = 0;
  for (int trial = 0; trial < samples(400); ++trial) {
    const Zonotope set = own_motors(Eigen::VectorXd::NullaryExpr(n, [&] { return 1.5 + any(); }));
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, 1 + k, any);
    const Eigen::VectorXd tau = Eigen::VectorXd::NullaryExpr(n, any) / 4;
    const double size = random.uniform(0, 0.2);
    const Eigen::MatrixXd off =
        size * Eigen::MatrixXd::NullaryExpr(n, 2 + k, [&] { return random.uniform(0, 1); });
    FreeLimits limits(set, Eigen::MatrixXd::Constant(n, 2 + k, 2));
    if (!limits.find(tau, A, off, kInfinity)) continue;
    ++found;
    const Eigen::MatrixXd P = Eigen::MatrixXd::NullaryExpr(k, n, any);
    Eigen::VectorXd R;
    limits.rest(P, A, off, R);
    for (int sample = 0; sample < 200; ++sample) {
      const Eigen::MatrixXd by = off.cwiseProduct(Eigen::MatrixXd::NullaryExpr(n, 2 + k, any));
      const Eigen::VectorXd z =
          1.1 * limits.Z().cwiseProduct(Eigen::VectorXd::NullaryExpr(1 + k, any));
      const Eigen::VectorXd u = tau + by.col(0) + (A + by.rightCols(1 + k)) * z;
      if ((u.array() > set.u_max.array()).any() || (u.array() < set.u_min.array()).any()) continue;
      ++seen;
      EXPECT_TRUE((z.array().abs() <= limits.Z().array()).all()) << z.transpose();
      const Eigen::VectorXd rest = z.tail(k) - P * (u - tau);
      EXPECT_TRUE((rest.array().abs() <= R.array() + 1e-12).all()) << rest.transpose();
    }
  }
  EXPECT_GT(found, samples(400) / 8);
  EXPECT_GT(seen, 100);
}

}  // namespace
}  // namespace maxwrench
