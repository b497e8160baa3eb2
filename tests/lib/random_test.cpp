#include "lib/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace maxwrench {
namespace {

TEST(RandomTest, NumbersArePinned) {
  // By an independent implementation in Python, so that published rows can be repeated.
  Random one(1);
  EXPECT_EQ(one.next(), 0x82cfecab5b995a13u);
  EXPECT_EQ(one.next(), 0x541f941cfe3827ddu);
  EXPECT_EQ(one.next(), 0xda31a038399e7f84u);
  Random stream(1, 1);
  EXPECT_EQ(stream.next(), 0x0e17b859d95c24efu);
  EXPECT_EQ(stream.next(), 0x1111270bc6698f5eu);
  EXPECT_EQ(Random(2).next(), 0xde871fed9e4ca3dau);
  EXPECT_EQ(Random(1).uniform(), 0.5109851759294534);
}

TEST(RandomTest, UniformHasTheMomentsOfTheUnitInterval) {
  // Mean 1/2, variance 1/12, E x^4 = 1/5. The mean of a million has a standard deviation of 3e-4.
  Random random(3);
  const int n = 1000000;
  double first = 0, second = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    first += x / n;
    second += (x - 0.5) * (x - 0.5) / n;
    fourth += x * x * x * x / n;
  }
  EXPECT_NEAR(first, 0.5, 1.5e-3);
  EXPECT_NEAR(second, 1.0 / 12, 5e-4);
  EXPECT_NEAR(fourth, 0.2, 1.5e-3);
}

TEST(RandomTest, UniformFillsItsBins) {
  // A chi-square of 99 degrees of freedom exceeds 150 with a probability of about 7e-4.
  Random random(4);
  std::vector<double> bins(100, 0);
  for (int i = 0; i < 100000; ++i) ++bins[static_cast<int>(random.uniform(0, 100))];
  double chi_square = 0;
  for (const double bin : bins) chi_square += (bin - 1000) * (bin - 1000) / 1000;
  EXPECT_LT(chi_square, 150);
  EXPECT_GT(chi_square, 60);
}

TEST(RandomTest, NormalHasItsMoments) {
  // 0, 1, 0 and 3.
  Random random(5);
  const int n = 1000000;
  double moments[5] = {};
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    ASSERT_TRUE(std::isfinite(x));
    for (int k = 1; k <= 4; ++k) moments[k] += std::pow(x, k) / n;
  }
  EXPECT_NEAR(moments[1], 0, 5e-3);
  EXPECT_NEAR(moments[2], 1, 7e-3);
  EXPECT_NEAR(moments[3], 0, 2e-2);
  EXPECT_NEAR(moments[4], 3, 5e-2);
}

TEST(RandomTest, StreamsAndSeedsDiffer) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (std::uint64_t stream = 0; stream < 100; ++stream) seen.insert(Random(seed, stream).next());
  EXPECT_EQ(seen.size(), 10000u);
}

TEST(RandomTest, NeighbouringStreamsAreUncorrelated) {
  // The mean of n products of centred uniforms has a standard deviation of 1/(12 sqrt(n)) = 2.6e-4.
  const int n = 100000;
  for (std::uint64_t stream = 0; stream < 4; ++stream) {
    Random a(7, stream), b(7, stream + 1);
    double product = 0;
    for (int i = 0; i < n; ++i) product += (a.uniform() - 0.5) * (b.uniform() - 0.5) / n;
    EXPECT_NEAR(product, 0, 1.2e-3);
  }
}

}  // namespace
}  // namespace maxwrench
