#include "benchmarks/race/performance_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace maxwrench {
namespace {

/// Four instances: the first method is best on one, ties on another, fails on the third; nobody
/// solves the last.
BenchmarkSet small_benchmark_set() {
  return {"small",
          "us",
          {"first", "second", "third"},
          {{1, 2, kInfinity, kInfinity}, {4, 2, 6, kInfinity}, {kInfinity, 8, 3, kInfinity}}};
}

TEST(PerformanceProfile, RatiosToTheBestOfEachInstance) {
  const auto ratios = performance_ratios(small_benchmark_set());
  EXPECT_EQ(ratios[0], (std::vector<double>{1, 1, kInfinity, kInfinity}));
  EXPECT_EQ(ratios[1], (std::vector<double>{4, 1, 2, kInfinity}));
  EXPECT_EQ(ratios[2], (std::vector<double>{kInfinity, 4, 1, kInfinity}));
}

TEST(PerformanceProfile, FailuresStayInTheDenominator) {
  const std::vector<MethodStanding> all = stand(small_benchmark_set());
  ASSERT_EQ(all.size(), 3U);
  // rho(2): 2/4 of the first and the second, 1/4 of the third; rho(1): 2/4, 1/4, 1/4.
  EXPECT_EQ(all[0].method, "first");
  EXPECT_EQ(all[1].method, "second");
  EXPECT_EQ(all[0].solved, 2);
  EXPECT_EQ(all[1].solved, 3);
  EXPECT_EQ(all[1].instances, 4);
  EXPECT_DOUBLE_EQ(all[0].share_best, 0.5);
  EXPECT_DOUBLE_EQ(all[1].share_best, 0.25);
  EXPECT_DOUBLE_EQ(all[1].share_double, 0.5);
  EXPECT_EQ(all[1].cost, 5);          // of 2, 4, 6 and infinity
  EXPECT_EQ(all[0].cost, kInfinity);  // the middle two are 2 and infinity
  // Beside the first: 4/1, 2/2, and 0 where only the second has an answer.
  EXPECT_EQ(all[1].times, 1);
  EXPECT_TRUE(std::isnan(all[1].times_low));  // too few
  EXPECT_TRUE(std::isnan(all[0].p));
}

TEST(PerformanceProfile, SignsOfManyInstances) {
  BenchmarkSet benchmark_set{"", "us", {"slow", "fast"}, {{}, {}}};
  for (int i = 1; i <= 10; ++i) {
    benchmark_set.cost[0].push_back(3.0 * i);
    benchmark_set.cost[1].push_back(i);
  }
  const std::vector<MethodStanding> all = stand(benchmark_set);
  EXPECT_EQ(all[0].method, "fast");
  EXPECT_EQ(all[1].times, 3);
  EXPECT_EQ(all[1].times_low, 3);
  EXPECT_EQ(all[1].times_high, 3);
  EXPECT_DOUBLE_EQ(all[1].p, 2.0 / 1024);  // all ten signs alike
}

TEST(PerformanceProfile, AReferenceByName) {
  BenchmarkSet benchmark_set = small_benchmark_set();
  benchmark_set.reference = "second";
  const std::vector<MethodStanding> all = stand(benchmark_set);
  EXPECT_EQ(all[0].method, "first");
  EXPECT_EQ(all[0].reference, "second");
  EXPECT_EQ(all[0].times, 1);  // of 1/4, 2/2 and infinity
  EXPECT_TRUE(std::isnan(all[1].times));
  EXPECT_EQ(all[2].times, 4);  // of infinity, 8/2 and 3/6
}

TEST(PerformanceProfile, OneMethodAndNone) {
  EXPECT_TRUE(stand({}).empty());
  const std::vector<MethodStanding> one = stand({"", "us", {"only"}, {{5}}});
  EXPECT_EQ(one[0].share_best, 1);
  EXPECT_EQ(one[0].cost, 5);
}

}  // namespace
}  // namespace maxwrench
