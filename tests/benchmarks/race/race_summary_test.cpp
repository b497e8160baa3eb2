#include "benchmarks/race/race_summary.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace maxwrench {
namespace {

/// One attempt that rises to each value after so many evaluations, a thousandth of a second each.
Attempt attempt_of(const std::vector<std::pair<double, double>>& rises, double spent) {
  Attempt made;
  for (const auto& [evaluations, value] : rises) {
    made.run.rises.push_back({{evaluations, evaluations * 1e-3}, value});
    made.value = value;
  }
  made.run.spent = {spent, spent * 1e-3};
  return made;
}

Contender contender_of(const std::string& search, const std::vector<Attempt>& attempts) {
  Contender contender;
  contender.search = search;
  contender.attempts = attempts;
  return contender;
}

/// Best known values 100 and 10. `slow` gets to a thousandth of both, in 100 and 80 evaluations.
/// `fast` gets there on the first in 10, in one of two seeds on the second; `narrow` supports the
/// second alone. `none` supports neither.
std::vector<Comparison> two_problems() {
  Comparison first;
  first.default_search = "slow";
  first.contenders = {
      contender_of("narrow", {}),
      contender_of("slow",
                   {attempt_of({{50, 90}, {100, 99.95}}, 100), attempt_of({{100, 99.95}}, 100)}),
      contender_of("fast", {attempt_of({{10, 100}}, 20), attempt_of({{10, 99.95}}, 20)}),
      contender_of("none", {})};
  Comparison second;
  second.default_search = "slow";
  second.contenders = {
      contender_of("narrow", {attempt_of({{40, 10}}, 40), attempt_of({{40, 10}}, 40)}),
      contender_of("slow", {attempt_of({{80, 10}}, 80), attempt_of({{80, 10}}, 80)}),
      contender_of("fast", {attempt_of({{10, 9}}, 20), attempt_of({{60, 10}}, 60)}),
      contender_of("none", {})};
  return {first, second};
}

std::vector<std::string> names_of(const std::vector<const Contender*>& contenders) {
  std::vector<std::string> names;
  for (const Contender* contender : contenders) names.push_back(contender->search);
  return names;
}

const Standing& of(const std::vector<Standing>& all, const std::string& search) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const Standing& each) { return each.search == search; });
}

/// On the second problem ERT is 40, 80 and, as the seed that failed spent 20, (20 + 60)/1 = 80: two
/// are equal, and of these the median value decides, 10 above (9 + 10)/2.
TEST(RaceSummary, RanksByExpectedTimeThenByMedianValue) {
  const std::vector<Comparison> both = two_problems();
  EXPECT_EQ(names_of(ranking(both[0])), (std::vector<std::string>{"fast", "slow"}));
  EXPECT_EQ(names_of(ranking(both[1])), (std::vector<std::string>{"narrow", "slow", "fast"}));
}

TEST(RaceSummary, PutsThoseThatNeverGetThereLast) {
  Comparison one = two_problems()[1];
  one.proven = 10.5;  // 4.8 % above what any attempt found
  EXPECT_EQ(names_of(ranking(one)).back(), "fast");
  EXPECT_EQ(one.contenders[1].expected(one.target(), &Spent::seconds), kInfinity);
}

/// Against the best of each problem (0.01 s and 0.04 s): slow takes 10 and 2 times as long, median
/// 6; fast 1 and 2, median 1.5; narrow is absent from one, so that its median is infinite.
TEST(RaceSummary, StandsByTheMedianFactorOverAllProblems) {
  const std::vector<Comparison> both = two_problems();
  const std::vector<Standing> all = standings(both);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].search, "fast");
  EXPECT_EQ(all[1].search, "slow");
  EXPECT_EQ(all[2].search, "narrow");  // half of all seeds come to a thousandth, none of `none`
  EXPECT_DOUBLE_EQ(all[0].typical, 1.5);
  EXPECT_DOUBLE_EQ(all[0].worst, 2);
  EXPECT_DOUBLE_EQ(all[1].typical, 6);
  EXPECT_DOUBLE_EQ(all[1].worst, 10);
  EXPECT_EQ(all[2].typical, kInfinity);
  EXPECT_EQ(all[2].worst, kInfinity);
  EXPECT_DOUBLE_EQ(all[1].seconds[0], 0.1);
  EXPECT_DOUBLE_EQ(all[1].seconds[1], 0.08);
  EXPECT_EQ(all[2].seconds[0], kInfinity);
  EXPECT_TRUE(all[1].is_default);
  EXPECT_FALSE(all[0].is_default);
}

/// Of four pairs of problem and seed. 99.95 is within a thousandth of 100, not within a
/// ten-thousandth; 9 is within a tenth of 10.
TEST(RaceSummary, CountsWhatCameToEachTarget) {
  const std::vector<Comparison> both = two_problems();
  const std::vector<Standing> all = standings(both);
  using Shares = std::array<double, 4>;
  EXPECT_EQ(of(all, "slow").reached, (Shares{1, 1, 1, 0.5}));
  EXPECT_EQ(of(all, "fast").reached, (Shares{1, 0.75, 0.75, 0.5}));
  EXPECT_EQ(of(all, "narrow").reached, (Shares{0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(of(all, "none").reached, (Shares{0, 0, 0, 0}));
  EXPECT_EQ(of(all, "narrow").supported, 1);
  EXPECT_EQ(of(all, "none").supported, 0);
}

TEST(RaceSummary, LeadersHoldTheDefaultWhereverItStands) {
  const std::vector<Comparison> both = two_problems();
  const std::vector<Standing> all = standings(both);
  EXPECT_EQ(leaders(all, 1), (std::vector<std::string>{"slow"}));
  EXPECT_EQ(leaders(all, 2), (std::vector<std::string>{"fast", "slow"}));
  EXPECT_EQ(leaders(all, 3), (std::vector<std::string>{"fast", "slow", "narrow"}));
}

/// Sixteen triples of problem, seed and target; `fast` comes to 8 of them with 10 evaluations (the
/// first problem: three targets of one seed, all four of the other, and a tenth on the second) and
/// to 4 more with 60; `narrow` to 8 with 40.
TEST(RaceSummary, DistributionOverTargetsCountsWhatIsNotSupported) {
  const std::vector<Comparison> both = two_problems();
  const auto fast = target_ecdf(both, "fast", &Spent::evaluations);
  EXPECT_DOUBLE_EQ(share_reached(fast, 9), 0);
  EXPECT_DOUBLE_EQ(share_reached(fast, 10), 8 / 16.0);
  EXPECT_DOUBLE_EQ(share_reached(fast, 60), 12 / 16.0);
  const auto narrow = target_ecdf(both, "narrow", &Spent::seconds);
  EXPECT_DOUBLE_EQ(share_reached(narrow, 1), 8 / 16.0);
  EXPECT_TRUE(target_ecdf(both, "none", &Spent::seconds).empty());
}

}  // namespace
}  // namespace maxwrench
