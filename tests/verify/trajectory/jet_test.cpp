#include "verify/trajectory/jet.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

bool holds(const Narrow& interval, double x) { return interval.low <= x && x <= interval.high; }

/// t = m + s with its rate, over |s| <= r.
template <int N>
Jet<N> time_about(double m, double r) {
  Jet<N> t;
  t.c[0] = {m - r, m + r};
  t.c[1] = 1.0;
  return t;
}

/// Of t^2 cos(3 t) the derivatives are known: with f = t^2, g = cos 3t, Leibniz' rule gives
/// sum of binomial(k, j) f^(j) g^(k-j).
TEST(Jet, HoldsTheDerivativesOfAProduct) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double m = random.uniform(-4, 4), r = i % 2 == 0 ? 0 : random.uniform(0, 0.2);
    const Jet<4> t = time_about<4>(m, r);
    const Jet<4> y = t * t * cos_sin(Narrow(3.0) * t)[0];
    const double at = m + random.uniform(-1, 1) * r;
    const double c = std::cos(3 * at), s = std::sin(3 * at);
    const double derivatives[] = {
        at * at * c, 2 * at * c - 3 * at * at * s, 2 * c - 12 * at * s - 9 * at * at * c,
        -18 * s - 54 * at * c + 27 * at * at * s, -108 * c + 216 * at * s + 81 * at * at * c};
    double factorial = 1;
    for (std::size_t k = 0; k <= 4; ++k) {
      if (k > 0) factorial *= static_cast<double>(k);
      const double value = derivatives[k] / factorial;
      const double rounding = 1e-12;  // of `value`, not of the jet
      EXPECT_TRUE(holds({y.c[k].low - rounding, y.c[k].high + rounding}, value)) << k;
      if (r == 0) {
        EXPECT_LT(y.c[k].high - y.c[k].low, 1e-10);
      }
    }
  }
}

TEST(Jet, DerivativeShiftsTheCoefficients) {
  Jet<3> y;
  for (std::size_t k = 0; k <= 3; ++k) y.c[k] = static_cast<double>(k + 1);
  const Jet<2> rate = derivative(y);
  for (std::size_t k = 0; k <= 2; ++k) {
    EXPECT_TRUE(holds(rate.c[k], static_cast<double>((k + 1) * (k + 2))));
  }
}

/// |x| x on both sides of zero and across it: from its closed form at sampled times.
TEST(Jet, SignedSquareHoldsAcrossZero) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double m = random.uniform(-0.3, 0.3), r = random.uniform(0, 0.3);
    const Jet<2> t = time_about<2>(m, r);
    const Jet<2> x = t + t * t;  // x = t + t^2, x_1 = 1 + 2 t, x_2 = 1
    const Jet<2> y = signed_square(x);
    const double at = m + random.uniform(-1, 1) * r;
    const double value = at + at * at, rate = 1 + 2 * at, sign = value > 0 ? 1 : -1;
    const double rounding = 1e-14;
    const double expected[] = {value * std::abs(value), 2 * std::abs(value) * rate,
                               2 * std::abs(value) * 1 + sign * rate * rate};
    for (std::size_t k = 0; k <= 2; ++k) {
      EXPECT_TRUE(holds({y.c[k].low - rounding, y.c[k].high + rounding}, expected[k])) << k;
    }
  }
}

TEST(Jet, EnclosesCosineAndSineOfWideIntervals) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double m = random.uniform(-10, 10), r = random.uniform(0, 3);
    const CosSin<double> all = enclose({m - r, m + r});
    const double x = m + random.uniform(-1, 1) * r;
    EXPECT_LE(all.c.low, std::cos(x) + 1e-15);
    EXPECT_GE(all.c.high, std::cos(x) - 1e-15);
    EXPECT_LE(all.s.low, std::sin(x) + 1e-15);
    EXPECT_GE(all.s.high, std::sin(x) - 1e-15);
  }
}

}  // namespace
}  // namespace maxwrench
