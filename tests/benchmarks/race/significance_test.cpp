#include "benchmarks/race/significance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/math/random.h"
#include "maxwrench/types.h"

namespace maxwrench {
namespace {

/// The probability that the k-th smallest of n draws with replacement is at most each place, by all
/// n^n draws.
std::vector<double> places_by_enumeration(int n, int k) {
  std::vector<double> share(static_cast<std::size_t>(n) + 1, 0);
  std::vector<int> draw(static_cast<std::size_t>(n), 1);
  const double all = std::pow(n, n);
  for (long i = 0; i < std::lround(all); ++i) {
    long rest = i;
    for (int& place : draw) {
      place = static_cast<int>(rest % n) + 1;
      rest /= n;
    }
    std::nth_element(draw.begin(), draw.begin() + k - 1, draw.end());
    for (int place = draw[static_cast<std::size_t>(k - 1)]; place <= n; ++place) {
      share[static_cast<std::size_t>(place)] += 1 / all;
    }
  }
  return share;
}

/// The first place whose share is no less.
int quantile_of(const std::vector<double>& share, double probability) {
  int place = 1;
  while (share[static_cast<std::size_t>(place)] < probability) ++place;
  return place;
}

TEST(Significance, SLOW_MedianIntervalIsThatOfEveryResample) {
  for (const int n : {6, 7}) {
    std::vector<double> places;
    for (int i = n; i >= 1; --i) places.push_back(i);  // the value is the place
    const std::vector<double> low = places_by_enumeration(n, (n + 1) / 2);
    const std::vector<double> high = places_by_enumeration(n, n / 2 + 1);
    for (const double confidence : {0.5, 0.8, 0.95, 0.99}) {
      const ConfidenceInterval interval = median_interval(places, confidence);
      EXPECT_EQ(interval.low, quantile_of(low, (1 - confidence) / 2)) << n << " " << confidence;
      EXPECT_EQ(interval.high, quantile_of(high, (1 + confidence) / 2)) << n << " " << confidence;
    }
  }
}

/// The same by drawing, of a sample too large to enumerate.
TEST(Significance, MedianIntervalIsThatOfManyResamples) {
  constexpr int kValues = 51, kDraws = 20000;
  Random random(1);
  std::vector<double> values, medians;
  for (int i = 0; i < kValues; ++i) values.push_back(std::exp(random.normal()));
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> again;
    for (int i = 0; i < kValues; ++i) again.push_back(values[random.next() % kValues]);
    std::nth_element(again.begin(), again.begin() + kValues / 2, again.end());
    medians.push_back(again[kValues / 2]);
  }
  const ConfidenceInterval interval = median_interval(values);
  const auto share = [&](auto counts) {
    return std::count_if(medians.begin(), medians.end(), counts) / double(kDraws);
  };
  // A share of 0.025 of 20,000 draws is known within 0.0011 (one sigma); steps of the sample count
  // on one side.
  EXPECT_LT(share([&](double m) { return m < interval.low; }), 0.025 + 0.004);
  EXPECT_GT(share([&](double m) { return m <= interval.low; }), 0.025 - 0.004);
  EXPECT_LT(share([&](double m) { return m > interval.high; }), 0.025 + 0.004);
  EXPECT_GT(share([&](double m) { return m >= interval.high; }), 0.025 - 0.004);
}

TEST(Significance, FewOrEndlessValues) {
  EXPECT_TRUE(std::isnan(median_interval({}).low));
  EXPECT_TRUE(std::isnan(median_interval({1, 2, 3, 4, 5}).high));
  const ConfidenceInterval most =
      median_interval({1, 2, 3, kInfinity, kInfinity, kInfinity, kInfinity});
  EXPECT_EQ(most.low, 2);  // P(Binomial(7, 1/7) >= 4) = 0.010, P(Binomial(7, 2/7) >= 4) = 0.10
  EXPECT_EQ(most.high, kInfinity);
  const ConfidenceInterval equal = median_interval(std::vector<double>(30, 4.0));
  EXPECT_EQ(equal.low, 4);
  EXPECT_EQ(equal.high, 4);
  const ConfidenceInterval many =
      median_interval(std::vector<double>(5000, 4.0));  // no power underflows
  EXPECT_EQ(many.low, 4);
  std::vector<double> places(100'000);  // normal: the middle and 1.96 * sqrt(n)/2 on each side
  std::iota(places.begin(), places.end(), 1);
  EXPECT_NEAR(median_interval(places).low, 50000 - 310, 2);
  EXPECT_NEAR(median_interval(places).high, 50000 + 310, 2);
}

/// Twice the share of the 2^n signs whose sum of ranks is no nearer to one end.
double p_by_enumeration(const std::vector<double>& differences) {
  std::vector<double> sizes;
  double positive = 0, total = 0;
  for (const double d : differences) {
    if (d != 0) sizes.push_back(std::abs(d));
  }
  std::vector<double> ranks;
  for (const double size : sizes) {  // the mean place among equal ones
    const auto less = std::count_if(sizes.begin(), sizes.end(), [&](double s) { return s < size; });
    const auto equal = std::count(sizes.begin(), sizes.end(), size);
    ranks.push_back(static_cast<double>(less) + (static_cast<double>(equal) + 1) / 2);
    total += ranks.back();
  }
  std::size_t i = 0;
  for (const double d : differences) {
    if (d != 0 && ++i) positive += d > 0 ? ranks[i - 1] : 0;
  }
  const double observed = std::min(positive, total - positive);
  const std::size_t all = std::size_t{1} << ranks.size();
  double below = 0;
  for (std::size_t signs = 0; signs < all; ++signs) {
    double sum = 0;
    for (std::size_t k = 0; k < ranks.size(); ++k) sum += (signs >> k) & 1U ? ranks[k] : 0;
    below += sum <= observed ? 1 : 0;
  }
  return std::min(1.0, 2 * below / static_cast<double>(all));
}

TEST(Significance, SignedRanksAreThoseOfAllSigns) {
  const std::vector<std::vector<double>> samples = {
      {3},
      {1, -2},
      {1, 2, 3, 4, 5, 6},
      {0.5, -0.25, 3, 4, -1, 2, 2.5},
      {1, 1, -1, 2, 2, -3, 0, 0, 5},                  // ties and zeros
      {kInfinity, kInfinity, -1, 2, -kInfinity, 3}};  // infinite ones are ties, too
  for (const auto& sample : samples) {
    EXPECT_NEAR(wilcoxon_signed_rank(sample), p_by_enumeration(sample), 1e-12);
  }
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> sample;
    for (int i = 0; i < 12; ++i) sample.push_back(std::floor(random.uniform(-4, 7)));
    EXPECT_NEAR(wilcoxon_signed_rank(sample), p_by_enumeration(sample), 1e-12);
  }
}

TEST(Significance, NothingDiffersWithoutDifferences) {
  EXPECT_EQ(wilcoxon_signed_rank({}), 1);
  EXPECT_EQ(wilcoxon_signed_rank(std::vector<double>{0, 0, NAN}), 1);
}

/// One more than what is counted exactly: the normal form must continue it.
TEST(Significance, LargeSamplesContinueSmallOnes) {
  Random random(3);
  std::vector<double> sample;
  for (int i = 0; i < 100; ++i) sample.push_back(random.normal() + 0.2);
  const double exact = wilcoxon_signed_rank(sample);
  sample.push_back(1e-9);  // the smallest rank hardly matters
  EXPECT_NEAR(wilcoxon_signed_rank(sample) / exact, 1, 0.05);
  sample.assign(100'000, 1);  // ranks beyond any int in sum
  sample.resize(200'000, -1);
  EXPECT_EQ(wilcoxon_signed_rank(sample), 1);
}

/// The smallest of three counts three times, and none falls below one that was smaller.
TEST(Significance, HolmCorrectsForTheNumberOfTests) {
  const std::vector<double> corrected = holm(std::vector<double>{0.02, 0.01, 0.9, 0.019});
  EXPECT_DOUBLE_EQ(corrected[1], 0.04);
  EXPECT_DOUBLE_EQ(corrected[3], 0.057);
  EXPECT_DOUBLE_EQ(corrected[0], 0.057);  // 2 * 0.02 is less than that before it
  EXPECT_DOUBLE_EQ(corrected[2], 0.9);
  EXPECT_TRUE(holm({}).empty());
}

}  // namespace
}  // namespace maxwrench
