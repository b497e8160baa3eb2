#include "verify/interval.h"

#include <gtest/gtest.h>
#include <mpfi.h>

#include <cmath>
#include <utility>

#include "lib/math/random.h"
#include "tests/support/support.h"
#include "verify/wide_matrix.h"

namespace maxwrench {
namespace {

constexpr int kDraws = samples(20'000);
constexpr mpfr_prec_t kBits = 400;  // a product of two long doubles has 128

/// An interval of MPFI, far narrower than one of a long double.
class Exact {
 public:
  Exact() { mpfi_init2(value, kBits); }
  explicit Exact(const Interval<long double>& x) : Exact() {
    mpfr_set_ld(&value->left, x.low, MPFR_RNDD);
    mpfr_set_ld(&value->right, x.high, MPFR_RNDU);
  }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  ~Exact() { mpfi_clear(value); }

  mpfi_t value;
};

template <class T>
Interval<long double> widened(const Interval<T>& x) {
  return {x.low, x.high};
}

/// `x` contains the exact result, and is wider than that by at most `ulps` of its magnitude (and
/// what keeps it away from denormal numbers) to each side.
template <class T>
void expect_tight(const Interval<T>& x, const Exact& exact, double ulps) {
  EXPECT_GE(mpfr_cmp_ld(&exact.value->left, x.low), 0);
  EXPECT_LE(mpfr_cmp_ld(&exact.value->right, x.high), 0);
  const T more = T(ulps) * (x.magnitude() * std::numeric_limits<T>::epsilon() + T(kTiny));
  EXPECT_LE(mpfr_cmp_ld(&exact.value->left, static_cast<long double>(x.low) + more), 0);
  EXPECT_GE(mpfr_cmp_ld(&exact.value->right, static_cast<long double>(x.high) - more), 0);
}

/// Of any sign and of magnitudes 1e-20 to 1e20, now and then 0 or a power of two.
template <class T>
T draw(Random& random) {
  const double kind = random.uniform();
  const T size = std::pow(T(10), T(random.uniform(-20, 20)));
  const T sign = random.uniform() < 0.5 ? T(-1) : T(1);
  if (kind < 0.05) return 0;
  if (kind < 0.15) return sign * std::exp2(std::round(T(random.uniform(-60, 60))));
  return sign * size * (1 + T(random.uniform()) * std::numeric_limits<T>::epsilon());
}

template <class T>
Interval<T> draw_interval(Random& random) {
  const T a = draw<T>(random), b = random.uniform() < 0.3 ? a : draw<T>(random);
  return {std::min(a, b), std::max(a, b)};
}

template <class T>
class IntervalOf : public testing::Test {};
using Scalars = testing::Types<double, long double>;
TYPED_TEST_SUITE(IntervalOf, Scalars);

/// Sum, difference and product are rounded once and widened by an ulp; so are both factors of a
/// quotient's product before it.
TYPED_TEST(IntervalOf, ContainsTheExactResult) {
  using T = TypeParam;
  Random random(1);
  Exact result;
  for (int i = 0; i < kDraws && !this->HasFailure(); ++i) {
    const Interval<T> a = draw_interval<T>(random), b = draw_interval<T>(random);
    const Exact x(widened(a)), y(widened(b));
    mpfi_add(result.value, x.value, y.value);
    expect_tight(a + b, result, 3);
    mpfi_sub(result.value, x.value, y.value);
    expect_tight(a - b, result, 3);
    mpfi_mul(result.value, x.value, y.value);
    expect_tight(a * b, result, 3);
    const Interval<T> positive = {std::abs(draw<T>(random)) + T(1e-20), T(1e21)};
    const Exact z(widened(positive));
    mpfi_div(result.value, x.value, z.value);
    expect_tight(a / positive, result, 8);
  }
}

/// A number times an interval is the same operation with one member.
TYPED_TEST(IntervalOf, ScaledByANumber) {
  using T = TypeParam;
  Random random(2);
  Exact result;
  for (int i = 0; i < kDraws && !this->HasFailure(); ++i) {
    const T factor = draw<T>(random);
    const Interval<T> a = draw_interval<T>(random);
    const Exact x(widened(Interval<T>(factor))), y(widened(a));
    mpfi_mul(result.value, x.value, y.value);
    expect_tight(factor * a, result, 3);
  }
}

TYPED_TEST(IntervalOf, RootIsNotBelow) {
  using T = TypeParam;
  Random random(3);
  Exact root;
  for (int i = 0; i < kDraws && !this->HasFailure(); ++i) {
    const T x = std::abs(draw<T>(random));
    const Exact of(widened(Interval<T>(x)));
    mpfi_sqrt(root.value, of.value);
    const T above = root_above(x);
    EXPECT_LE(mpfr_cmp_ld(&root.value->right, above), 0);
    const T most = above - 3 * (above * std::numeric_limits<T>::epsilon() + T(kTiny));
    EXPECT_GE(mpfr_cmp_ld(&root.value->left, most), 0);
  }
}

/// Angles are doubled up to once for each bit of their size: errors grow with it.
TEST(Interval, EnclosesCosineAndSine) {
  Random random(4);
  Exact c, s;
  for (int i = 0; i < kDraws && !testing::Test::HasFailure(); ++i) {
    const double x = random.uniform(-1, 1) * std::pow(10, random.uniform(-12, 2));
    const Exact angle(Interval<long double>{x});
    const CosSin<long double> enclosed = enclose_wide(x);
    mpfi_cos(c.value, angle.value);
    mpfi_sin(s.value, angle.value);
    for (const auto& [ours, exact] : {std::pair(enclosed.c, &c), std::pair(enclosed.s, &s)}) {
      EXPECT_GE(mpfr_cmp_ld(&exact->value->left, ours.low), 0) << x;
      EXPECT_LE(mpfr_cmp_ld(&exact->value->right, ours.high), 0) << x;
      EXPECT_LE(ours.high - ours.low, 1e-15L * std::max(1.0, std::abs(x))) << x;
    }
  }
}

TEST(Interval, NarrowContainsWide) {
  Random random(5);
  for (int i = 0; i < kDraws; ++i) {
    const Wide x = draw_interval<long double>(random);
    const Narrow y = narrow(x);
    ASSERT_LE(static_cast<long double>(y.low), x.low);
    ASSERT_GE(static_cast<long double>(y.high), x.high);
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
TEST(WideMatrix, RejectsSingularMatrices) {
  EXPECT_THROW(enclose_inverse(to_wide(Eigen::MatrixXd::Ones(2, 2))), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
