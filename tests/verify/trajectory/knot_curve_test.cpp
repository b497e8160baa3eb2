#include "verify/trajectory/knot_curve.h"

#include <gtest/gtest.h>

#include "lib/math/cubic_spline.h"
#include "lib/math/random.h"

namespace maxwrench {
namespace {

double middle(const Narrow& x) { return (x.low + x.high) / 2; }

/// Two knots 0 and 1 at rest: 3 x^2 - 2 x^3, which peaks in its rate with 1.5/T at the middle.
TEST(KnotCurve, IsTheClampedCubic) {
  Eigen::MatrixXd table(2, 1);
  table << 0, 1;
  const KnotCurve curve(table, 2);
  for (const double x : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    const Jet<3> y = curve.at<3>(0, 0, Narrow(x));
    EXPECT_NEAR(middle(y.c[0]), x * x * (3 - 2 * x), 1e-15);
    EXPECT_NEAR(middle(y.c[1]), 6 * x * (1 - x) / 2, 1e-15);
    EXPECT_NEAR(middle(y.c[2]), (6 - 12 * x) / 8, 1e-15);
    EXPECT_NEAR(middle(y.c[3]), -12.0 / 8 / 6, 1e-15);
  }
  EXPECT_FALSE(curve.leaves(0, true, -0.75, 0.75, 1e-9).found);
  const KnotCurve::Outside where = curve.leaves(0, true, -0.7, 0.7, 1e-9);
  ASSERT_TRUE(where.found);
  EXPECT_GT(6 * where.x * (1 - where.x) / 2, 0.7);
}

/// The spline of `lib` is found through its second derivatives at the knots, this one through its
/// slopes.
TEST(KnotCurve, AgreesWithTheOtherSpline) {
  Random random(1);
  const double T = 3.7;
  Eigen::MatrixXd table(7, 2);
  for (double& x : table.reshaped()) x = random.uniform(-2, 2);
  const KnotCurve curve(table, T);
  std::vector<double> times;
  for (int i = 0; i < 7; ++i) times.push_back(i * T / 6);
  const Eigen::MatrixXd values = table.transpose(), bends = clamped_spline_bends(times, values);
  for (int i = 0; i < 200; ++i) {
    const double t = random.uniform(0, T);
    const SplineInstant at = spline_at(times, t);
    const double x = t / T * 6 - at.interval;
    for (int j = 0; j < 2; ++j) {
      Eigen::Vector4d four;
      four << values(j, at.interval), values(j, at.interval + 1), bends(j, at.interval),
          bends(j, at.interval + 1);
      const Eigen::Vector3d expected = at.weights.transpose() * four;
      const Jet<3> y = curve.at<3>(j, at.interval, Narrow(x));
      EXPECT_NEAR(middle(y.c[0]), expected[0], 1e-12);
      EXPECT_NEAR(middle(y.c[1]), expected[1], 1e-12);
      EXPECT_NEAR(2 * middle(y.c[2]), expected[2], 1e-11);
    }
  }
}

/// y = 3 x^2 - 2 x^3 up to 1 and back to 0.9 overshoots between the knots. A limit just below the
/// peak is violated there, for less than a thousandth of an interval, and one just above is not.
TEST(KnotCurve, FindsANarrowPeak) {
  Eigen::MatrixXd table(3, 1);
  table << 0, 1, 0.9;
  const KnotCurve curve(table, 2);
  // In between: slope m at the middle knot with 0 + 4 m + 0 = 3 (0.9 - 0), m = 0.675. On the second
  // interval y = 1 + m x + (3 (-0.1) - 2 m) x^2 + (2 (0.1) + m) x^3.
  const double m = 0.675, b = -0.3 - 2 * m, c = 0.2 + m;
  const double x = (-b - std::sqrt(b * b - 3 * c * m)) / (3 * c);
  const double peak = 1 + m * x + b * x * x + c * x * x * x;
  EXPECT_FALSE(curve.leaves(0, false, -1, peak + 1e-12, 0).found);
  const KnotCurve::Outside where = curve.leaves(0, false, -1, peak - 1e-7, 0);
  ASSERT_TRUE(where.found);
  EXPECT_EQ(where.interval, 1);
  EXPECT_NEAR(where.x, x, 1e-3);
  EXPECT_FALSE(curve.leaves(0, false, -1, peak - 1e-7, 1.1e-7).found);
  EXPECT_TRUE(curve.leaves(0, false, 0.1, 2, 0).found);  // it starts below
}

TEST(KnotCurve, RejectsNaN) {
  Eigen::MatrixXd table(3, 1);
  table << 0, std::nan(""), 0.9;
  EXPECT_TRUE(KnotCurve(table, 2).leaves(0, false, -10, 10, 0).found);
}

}  // namespace
}  // namespace maxwrench
