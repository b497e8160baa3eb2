#include "verify/interval.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"
#include "verify/wide_matrix.h"

namespace maxwrench {
namespace {

bool holds(const Narrow& x, long double exact) { return x.low <= exact && exact <= x.high; }

/// Sums and products of numbers with 30 binary digits are exact in a long double, which has 64.
TEST(Interval, ContainsExactResults) {
  Random random(1);
  const auto draw = [&] { return std::ldexp(std::floor(random.uniform(-1, 1) * 0x1p30), -20); };
  for (int i = 0; i < 10000; ++i) {
    const double a = draw(), b = draw();
    const Narrow x(std::min(a, b), std::max(a, b)), y(draw());
    for (const double at : {a, b}) {
      EXPECT_TRUE(holds(x + y, static_cast<long double>(at) + y.low));
      EXPECT_TRUE(holds(x - y, static_cast<long double>(at) - y.low));
      EXPECT_TRUE(holds(x * y, static_cast<long double>(at) * y.low));
      EXPECT_TRUE(holds(y.low * x, static_cast<long double>(at) * y.low));
    }
    // An interval's member q = a / b has q b = a.
    const Narrow q = Narrow(a) / Narrow(std::abs(b) + 1);
    EXPECT_TRUE(holds(q * Narrow(std::abs(b) + 1), a));
    EXPECT_LT(q.high - q.low, 1e-14 * (1 + q.magnitude()));
  }
}

TEST(Interval, StepsOutward) {
  for (const double x : {0.0, 1.0, -1.0, 1 - 0x1p-53, 0x1p-1022, -0x1p-1022, 1e300, 5e-324}) {
    EXPECT_GT(Narrow::above(x), x);
    EXPECT_LT(Narrow::below(x), x);
    EXPECT_GE(Narrow::above(x), std::nextafter(x, 1e308));
    EXPECT_LE(Narrow::below(x), std::nextafter(x, -1e308));
  }
}

/// Against the library's long double, good to 1e-19.
TEST(Interval, EnclosesCosineAndSine) {
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const double x = i == 0 ? 0 : random.uniform(-20, 20);
    const CosSin<long double> at = enclose_wide(x);
    const long double c = std::cos(static_cast<long double>(x)),
                      s = std::sin(static_cast<long double>(x));
    EXPECT_LE(at.c.low, c + 1e-19L);
    EXPECT_GE(at.c.high, c - 1e-19L);
    EXPECT_LE(at.s.low, s + 1e-19L);
    EXPECT_GE(at.s.high, s - 1e-19L);
    EXPECT_LT(at.c.high - at.c.low, 1e-15L);
    const Wide one = at.c * at.c + at.s * at.s;
    EXPECT_LE(one.low, 1.0L);
    EXPECT_GE(one.high, 1.0L);
  }
}

/// The Hilbert matrix of order 5 has an inverse of whole numbers, condition 5e5.
TEST(WideMatrix, EnclosesAnInverse) {
  Eigen::MatrixXd A(5, 5);
  const double corner[5] = {25, -300, 1050, -1400, 630};
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) A(i, j) = 2520.0 / (i + j + 1);  // 1/2520 of it is Hilbert's
  }
  const WideRows inverse = enclose_inverse(to_wide(A));
  for (std::size_t j = 0; j < 5; ++j) {
    const long double exact = static_cast<long double>(corner[j]) / 2520;
    EXPECT_LE(inverse[0][j].low, exact + 1e-17L);
    EXPECT_GE(inverse[0][j].high, exact - 1e-17L);
    EXPECT_LT(inverse[0][j].high - inverse[0][j].low, 1e-12L);
  }
}

/// A singular matrix has none.
TEST(WideMatrix, RefusesSingularMatrices) {
  EXPECT_THROW(enclose_inverse(to_wide(Eigen::MatrixXd::Ones(2, 2))), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
