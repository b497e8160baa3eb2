#include "benchmarks/race/race_statistics.h"

#include <gtest/gtest.h>

namespace maxwrench {
namespace {

/// Three runs to 2: the first gets there with 10 evaluations in 1 s, the second with 30 in 2 s, the
/// third ends below it after 100 in 7 s.
std::vector<RaceRun> three_runs() {
  return {{{{{5, 0.5}, 1}, {{10, 1}, 2}}, {50, 4}},
          {{{{30, 2}, 3}}, {30, 2}},
          {{{{2, 0.1}, 1.5}}, {100, 7}}};
}

TEST(RaceStatistics, TargetsLieBelowWhateverTheSign) {
  EXPECT_DOUBLE_EQ(target_below(50, 0.1), 45);
  EXPECT_DOUBLE_EQ(target_below(-50, 0.1), -55);
  EXPECT_EQ(target_below(0, 0.1), 0);
  EXPECT_EQ(target_below(-kInfinity, 0.1), kInfinity);
}

TEST(RaceStatistics, FirstHits) {
  const RaceRun run = three_runs()[0];
  EXPECT_EQ(first_hit(run, 1).evaluations, 5);
  EXPECT_EQ(first_hit(run, 1.5).seconds, 1);
  EXPECT_EQ(first_hit(run, 2).evaluations, 10);
  EXPECT_EQ(first_hit(run, 2.1).evaluations, kInfinity);
  EXPECT_EQ(first_hit(run, 2.1).seconds, kInfinity);
  EXPECT_EQ(first_hit(RaceRun(), -kInfinity).seconds, kInfinity);  // without a value
  EXPECT_EQ(value_after(run, &Spent::evaluations, 4), -kInfinity);
  EXPECT_EQ(value_after(run, &Spent::evaluations, 9), 1);
  EXPECT_EQ(value_after(run, &Spent::seconds, 1), 2);
}

/// COCO's definition: what failures spend is paid by those that succeed.
TEST(RaceStatistics, ExpectedRunningTimeCountsFailures) {
  const std::vector<RaceRun> runs = three_runs();
  EXPECT_EQ(reached(runs, 2), 2);
  EXPECT_DOUBLE_EQ(expected_running_time(runs, 2, &Spent::evaluations), (10 + 30 + 100) / 2.0);
  EXPECT_DOUBLE_EQ(expected_running_time(runs, 2, &Spent::seconds), (1 + 2 + 7) / 2.0);
  EXPECT_DOUBLE_EQ(expected_running_time(runs, 1, &Spent::evaluations), (5 + 30 + 2) / 3.0);
  // The one that reaches 3 pays for the whole runs of both others, not for their way to 2.
  EXPECT_DOUBLE_EQ(expected_running_time(runs, 3, &Spent::evaluations), 50 + 30 + 100);
}

TEST(RaceStatistics, NoSuccessIsInfinite) {
  EXPECT_EQ(expected_running_time(three_runs(), 9, &Spent::seconds), kInfinity);
  EXPECT_EQ(expected_running_time(three_runs(), kInfinity, &Spent::seconds), kInfinity);
  EXPECT_EQ(expected_running_time({}, 1, &Spent::seconds), kInfinity);
}

/// An interrupted run is a failure that cost what it cost, also if it had been there.
TEST(RaceStatistics, InterruptedRunsFail) {
  std::vector<RaceRun> runs = three_runs();
  runs[0].interrupted = true;
  EXPECT_EQ(reached(runs, 2), 1);
  EXPECT_DOUBLE_EQ(expected_running_time(runs, 2, &Spent::seconds), 4 + 2 + 7);
}

/// Of five, two tie at 3, one comes at 8, two never: steps of 2/5 and 1/5.
TEST(RaceStatistics, EcdfHasTiesAndFailures) {
  const std::vector<EcdfStep> steps = ecdf({kInfinity, 3, 8, 3, kInfinity});
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].spent, 3);
  EXPECT_DOUBLE_EQ(steps[0].share, 0.4);
  EXPECT_EQ(steps[1].spent, 8);
  EXPECT_DOUBLE_EQ(steps[1].share, 0.6);
  EXPECT_EQ(share_reached(steps, 2.9), 0);
  EXPECT_DOUBLE_EQ(share_reached(steps, 3), 0.4);
  EXPECT_DOUBLE_EQ(share_reached(steps, 1e9), 0.6);
  EXPECT_TRUE(ecdf({kInfinity}).empty());
  EXPECT_TRUE(ecdf({}).empty());
}

TEST(RaceStatistics, Quartiles) {
  EXPECT_EQ(median({}), kInfinity);
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median({-kInfinity, -kInfinity, -kInfinity, 2}), -kInfinity);
  // Half of the runs fail: the middle is not known to be finite.
  EXPECT_EQ(median({1, kInfinity}), kInfinity);
  const Quartiles of_five = quartiles({5, 4, 3, 2, 1});
  EXPECT_EQ(of_five.low, 2);
  EXPECT_EQ(of_five.high, 4);
  const Quartiles with_failure = quartiles({1, 2, 3, kInfinity});  // places 0.75, 1.5, 2.25
  EXPECT_DOUBLE_EQ(with_failure.low, 1.75);
  EXPECT_DOUBLE_EQ(with_failure.median, 2.5);
  EXPECT_EQ(with_failure.high, kInfinity);
}

}  // namespace
}  // namespace maxwrench
