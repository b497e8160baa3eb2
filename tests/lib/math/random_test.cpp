#include "lib/math/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "tests/reference_models/splitmix64.h"

namespace maxwrench {
namespace {

/// The first numbers from seed 1234567, as published with many implementations.
TEST(RandomTest, ReferenceIsSplitMix64) {
  reference::SplitMix64 known(1234567);
  for (const std::uint64_t number :
       {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U,
        16408922859458223821U}) {
    EXPECT_EQ(known.next(), number);
  }
}

/// Published rows can be repeated: stream k of a seed starts where the first numbers of two
/// generators differ, that of the seed and that of the one which stream k seeds in turn.
TEST(RandomTest, StreamsAreThoseOfTheReference) {
  using reference::SplitMix64;
  for (const std::uint64_t seed : {1U, 2U, 77U}) {
    for (const std::uint64_t stream : {0U, 1U, 9U}) {
      const std::uint64_t turned = SplitMix64(stream + 1 - 0x9e3779b97f4a7c15).next();
      SplitMix64 known(SplitMix64(seed).next() ^ SplitMix64(turned).next());
      Random random(seed, stream);
      for (int i = 0; i < 10; ++i) EXPECT_EQ(random.next(), known.next());
      // The upper 53 bits, as a fraction.
      EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(known.next() >> 11), -53));
    }
  }
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

TEST(RandomTest, NoNumberOfAStreamComesAgainInAnother) {
  // Streams of any use, of neighbouring seeds and of their complements. Of 400,000 numbers of 64
  // bits two are equal with a probability of 4e-9, unless two streams overlap.
  std::set<std::uint64_t> seen;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 32; ++seed) {
    for (const std::uint64_t own : {seed, ~seed}) {
      for (const RandomUse use :
           {RandomUse::kSample, RandomUse::kLocalSearch, RandomUse::kRefine}) {
        for (std::uint64_t index = 0; index < 32; ++index) {
          Random random(own, use, index);
          for (int i = 0; i < 64; ++i, ++count) seen.insert(random.next());
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), count);
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
