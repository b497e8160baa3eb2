#include <gtest/gtest.h>

#include <string>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr const char* kTask = MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/luus.toml";

Answer found_by(const Problem& problem, long budget, int threads) {
  const Case c{problem.name, "linf_polytope", Wrench::kPure, "", "pontryagin", 1, budget};
  return solve(problem, {c, threads});
}

/// The plan is evaluated as any other, and the row has the mass of the extremal itself, 1 kg.
TEST(PontryaginSearch, SLOW_PrintsThePlanAndWhatItsExtremalCarries) {
  const Problem problem = load_problem(kTask);
  const Answer answer = found_by(problem, 700, 2);
  ASSERT_EQ(answer.status, Status::kBestFound) << answer.reason.c_str();
  EXPECT_LE(answer.evaluations, 700);
  const double value = answer.trajectory.value;
  EXPECT_GT(value, 0.2);      // the straight line: 0.07868
  EXPECT_LT(value, 0.87529);  // the best spline of 8 knots
  EXPECT_NE(answer.stopped.find("carries 1.0000"), std::string::npos) << answer.stopped;
  EXPECT_NE(answer.stopped.find("3 switches"), std::string::npos) << answer.stopped;
}

TEST(PontryaginSearch, IsTheSameAtAnyNumberOfThreads) {
  const Problem problem = load_problem(kTask);
  const long budget = kSanitized ? 5 : 60;
  const Answer one = found_by(problem, budget, 1), two = found_by(problem, budget, 2);
  EXPECT_EQ(one.trajectory.value, two.trajectory.value);
  EXPECT_EQ(one.evaluations, two.evaluations);
  EXPECT_EQ(one.stopped, two.stopped);
}

TEST(PontryaginSearch, StaysWithinSmallBudgets) {
  const Problem problem = load_problem(kTask);
  for (const long budget : {1L, 2L, 7L, kSanitized ? 8L : 30L}) {
    const Answer answer = found_by(problem, budget, 1);
    EXPECT_LE(answer.evaluations, budget);
    EXPECT_GE(answer.evaluations, 1);
    EXPECT_TRUE(answer.has_value()) << budget;  // that of the straight line at least
  }
}

TEST(PontryaginSearch, RejectsOtherTasks) {
  ASSERT_EQ(transfer_searches().size(), 1u);
  EXPECT_STREQ(transfer_searches()[0].name, "pontryagin");
  for (const char* name : {"uvms/valve_trajectory", "uvms/valve_impulse", "planar/force"}) {
    const Problem problem = load_problem(name);
    EXPECT_THROW(found_by(problem, 30, 1), std::invalid_argument) << name;
  }
}

}  // namespace
}  // namespace maxwrench
