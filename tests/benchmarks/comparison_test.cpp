#include "benchmarks/comparison.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"

namespace maxwrench {
namespace {

TEST(Comparison, Medians) {
  EXPECT_EQ(median({}), kInfinity);
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  // Half of the attempts fail: the middle is not known to be finite.
  EXPECT_EQ(median({1, kInfinity}), kInfinity);
}

TEST(Comparison, AttemptReadsItsHistory) {
  Attempt attempt;
  attempt.history = {{1, 2.0}, {10, 3.0}};
  attempt.improved_at = {0.5, 0.7};
  attempt.improved_to = {2, 3};
  EXPECT_EQ(attempt.evaluations_to(2.5), 10);
  EXPECT_EQ(attempt.evaluations_to(3.5), kInfinity);
  EXPECT_EQ(attempt.seconds_to(2), 0.5);
  EXPECT_EQ(attempt.seconds_to(9), kInfinity);
  EXPECT_EQ(attempt.value_after(0), -kInfinity);
  EXPECT_EQ(attempt.value_after(9), 2);
  EXPECT_EQ(attempt.value_after(10), 3);
}

TEST(Comparison, ClockSeesWhatTheHistorySees) {
  const Problem problem = load_problem("planar/force");
  for (const char* search : {"grid", "annealing", "cobyla", "nullspace"}) {
    SCOPED_TRACE(search);
    const Case c{problem.name, "linf_polytope", Wrench::kPure, "", search, 1, 500};
    const Attempt run = attempt(problem, resolve(problem, c));
    ASSERT_FALSE(run.improved_to.empty());
    EXPECT_EQ(run.improved_to.back(), run.value);
    EXPECT_EQ(run.history.back().value, run.value);
    EXPECT_LE(run.improved_at.back(), run.seconds);
    EXPECT_LE(run.evaluations, 500);
  }
}

}  // namespace
}  // namespace maxwrench
