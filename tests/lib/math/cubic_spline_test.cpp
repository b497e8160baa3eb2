#include "lib/math/cubic_spline.h"

#include <gtest/gtest.h>

#include <array>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

constexpr std::array<double, 5> kTimes = {0, 0.4, 1, 1.1, 3};

/// [value, slope, bend] d×3 at t.
Eigen::MatrixXd at(const Eigen::MatrixXd& values, const Eigen::MatrixXd& bends, double t) {
  const SplineInstant instant = spline_at(kTimes, t);
  Eigen::MatrixXd corners(values.rows(), 4);
  corners << values.middleCols(instant.interval, 2), bends.middleCols(instant.interval, 2);
  return corners * instant.weights;
}

Eigen::MatrixXd random_values(Random& random) {
  return Eigen::MatrixXd::NullaryExpr(3, 5, [&] { return 2 * random.uniform() - 1; });
}

/// 2 t^3 - 3 a t^2 has slope zero at 0 and a, and is a cubic, so its spline is itself.
TEST(CubicSpline, RepeatsACubicThatRestsAtBothEnds) {
  const double a = kTimes.back();
  Eigen::MatrixXd values(1, 5);
  for (int i = 0; i < 5; ++i) {
    const double t = kTimes[static_cast<std::size_t>(i)];
    values(0, i) = 2 * t * t * t - 3 * a * t * t;
  }
  const Eigen::MatrixXd bends = clamped_spline_bends(kTimes, values);
  for (double t = 0; t <= a; t += 0.09) {
    const Eigen::RowVector3d expected(2 * t * t * t - 3 * a * t * t, 6 * t * (t - a),
                                      12 * t - 6 * a);
    EXPECT_TRUE(at(values, bends, t).isApprox(expected, 1e-12)) << t;
  }
}

TEST(CubicSpline, IsSmoothAtTheKnotsAndRestsAtTheEnds) {
  Random random(1);
  const Eigen::MatrixXd values = random_values(random),
                        bends = clamped_spline_bends(kTimes, values);
  for (int i = 0; i < 5; ++i) {
    const double t = kTimes[static_cast<std::size_t>(i)], e = 1e-12;
    const Eigen::MatrixXd here = at(values, bends, t);
    EXPECT_TRUE(here.col(0).isApprox(values.col(i), 1e-14));
    EXPECT_TRUE(at(values, bends, t - e).isApprox(here, 1e-8));
    EXPECT_TRUE(at(values, bends, t + e).isApprox(here, 1e-8));
  }
  EXPECT_LT(at(values, bends, 0).col(1).norm(), 1e-14);
  EXPECT_LT(at(values, bends, kTimes.back()).col(1).norm(), 1e-14);
}

TEST(CubicSpline, SlopeAndBendAreDerivatives) {
  Random random(2);
  const Eigen::MatrixXd values = random_values(random),
                        bends = clamped_spline_bends(kTimes, values);
  constexpr double e = 1e-5;
  for (double t = 0.05; t < 3; t += 0.1) {
    const Eigen::MatrixXd here = at(values, bends, t);
    const Eigen::MatrixXd change = (at(values, bends, t + e) - at(values, bends, t - e)) / (2 * e);
    if (spline_at(kTimes, t - e).interval != spline_at(kTimes, t + e).interval) continue;
    EXPECT_LT((change.leftCols(2) - here.rightCols(2)).norm(), 1e-7) << t;
  }
}

/// Two knots: 3 s^2 - 2 s^3.
TEST(CubicSpline, OfTwoKnotsIsTheCubicFromRestToRest) {
  const std::array<double, 2> times = {0, 2};
  const Eigen::MatrixXd bends = clamped_spline_bends(times, Eigen::RowVector2d(0, 1));
  EXPECT_TRUE(bends.isApprox(Eigen::RowVector2d(1.5, -1.5)));
  const Eigen::Vector4d corners(0, 1, bends(0), bends(1));
  const SplineInstant instant = spline_at(times, 0.5);
  EXPECT_EQ(instant.interval, 0);
  EXPECT_NEAR(corners.dot(instant.weights.col(0)), 3. / 16 - 2. / 64, 1e-15);
}

TEST(CubicSpline, BendsAreLinearInTheValues) {
  Random random(3);
  const Eigen::MatrixXd values = random_values(random);
  const Eigen::MatrixXd map = clamped_spline_bends(kTimes, Eigen::MatrixXd::Identity(5, 5));
  EXPECT_TRUE((values * map).isApprox(clamped_spline_bends(kTimes, values), 1e-12));
}

TEST(CubicSpline, AKnotBelongsToTheIntervalAfterIt) {
  const std::array<int, 5> expected = {0, 1, 2, 3, 3};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(spline_at(kTimes, kTimes[i]).interval, expected[i]);
  EXPECT_EQ(spline_at(kTimes, -1).interval, 0);
  EXPECT_EQ(spline_at(kTimes, 9).interval, 3);
}

/// The slopes at the ends are those of polynomials through the first and last rows: a polynomial of
/// that degree is its own spline, at any times. Two rows are a line, three a parabola.
TEST(FreeSpline, ReproducesPolynomials) {
  const std::vector<double> all = {-0.3, 0.1, 0.9, 1.0, 2.5, 2.6};
  for (const std::size_t rows : {2, 3, 4, 6}) {
    const std::vector<double> times(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rows));
    const double a = 0.7, b = -2, c = rows > 2 ? 1.5 : 0, d = rows > 3 ? -0.4 : 0;
    Eigen::MatrixXd values(1, static_cast<Eigen::Index>(rows));
    for (std::size_t i = 0; i < rows; ++i) {
      const double t = times[i];
      values(0, static_cast<Eigen::Index>(i)) = a + b * t + c * t * t + d * t * t * t;
    }
    const Eigen::MatrixXd bends = free_spline_bends(times, values);
    for (int k = 0; k <= 20; ++k) {
      const double t = times.front() + k / 20.0 * (times.back() - times.front());
      const SplineInstant at = spline_at(times, t);
      const Eigen::Vector4d own(values(0, at.interval), values(0, at.interval + 1),
                                bends(0, at.interval), bends(0, at.interval + 1));
      EXPECT_NEAR(own.dot(at.weights.col(0)), a + b * t + c * t * t + d * t * t * t, 1e-12);
      EXPECT_NEAR(own.dot(at.weights.col(1)), b + 2 * c * t + 3 * d * t * t, 1e-11);
      EXPECT_NEAR(own.dot(at.weights.col(2)), 2 * c + 6 * d * t, 1e-10);
    }
  }
}

}  // namespace
}  // namespace maxwrench
