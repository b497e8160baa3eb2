#include "benchmarks/comparison.h"

#include <gtest/gtest.h>

#include <tuple>

#include "benchmarks/plan_row.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"

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
  for (const char* search : {"grid", "annealing", "cobyla", "nullspace", "slp"}) {
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

/// No posture can be held; a search of plans has seen values, with slack, that count for nothing.
TEST(Comparison, ValuesWithSlackAreNone) {
  Problem problem = load_problem("uvms/valve");
  add_body(problem.robot.links[0], 1000, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
  const Case c{problem.name, "linf_polytope", Wrench::kPure, "", "slp", 1, 60};
  const Attempt run = attempt(problem, resolve(problem, c));
  EXPECT_EQ(run.value, -kInfinity);
  EXPECT_GT(run.evaluations, 0);
  EXPECT_EQ(run.evaluations_to(-1e9), kInfinity);
  EXPECT_EQ(run.seconds_to(-1e9), kInfinity);
}

/// Of a static task by linf_polytope those of plans and between facets too; then the plain way, if
/// it has a solver.
TEST(Comparison, RacesTheSearchesThatServe) {
  const Problem problem = load_problem("planar/force");
  const auto postures = static_cast<long>(searches().size()) + 1;  // and the default
  const auto plans = static_cast<long>(plan_searches().size());
  const auto facets = static_cast<long>(facet_searches().size());
  Case c{.problem = problem.name};
  EXPECT_EQ(attempt_count(problem, c, 3), 3 * (postures + plans + facets + 1));
  c.measure = "ellipsoid";
  EXPECT_EQ(attempt_count(problem, c, 3), 3 * postures);
  c.measure = "linf_polytope";
  EXPECT_EQ(attempt_count(load_problem("planar/two_arms"), c, 1), postures + facets + 1);
}

/// Two of three seeds reach 2, after 1 s and 2 s; the third spends 7 s on less: (1 + 2 + 7) s / 2.
TEST(Comparison, ExpectedTimeCountsWhatMisses) {
  Contender contender;
  for (const auto& [value, at, seconds] :
       {std::tuple(2.0, 1.0, 4.0), std::tuple(3.0, 2.0, 2.0), std::tuple(1.0, 0.5, 7.0)}) {
    Attempt& attempt = contender.attempts.emplace_back();
    attempt.improved_at = {at};
    attempt.improved_to = {value};
    attempt.seconds = seconds;
  }
  EXPECT_EQ(contender.expected_seconds(2), 5);
  EXPECT_EQ(contender.expected_seconds(4), kInfinity);
}

/// The clock knows of no value beyond that of the plan that a search chose, and of that one.
TEST(Comparison, ClockSeesThePlanThatWasChosen) {
  const Problem problem = load_problem("planar/trajectory");
  for (const char* name : {"slp", "annealing"}) {
    SCOPED_TRACE(name);
    const Case c{problem.name, "linf_polytope", Wrench::kPure, "", name, 1, 80};
    const PlanMethod method = resolve_plan(problem, c);
    const Attempt run = attempt(problem, method);
    EXPECT_EQ(run.choice.scheme, "spline");
    ASSERT_FALSE(run.improved_to.empty());
    EXPECT_EQ(run.improved_to.back(), run.value);
    EXPECT_LE(run.improved_at.back(), run.seconds);
    EXPECT_LE(run.evaluations, 80);
    const PlanRow row = solve_plan(problem, method, 2);
    EXPECT_EQ(run.evaluations, row.evaluations);
    EXPECT_NEAR(run.value, row.plan.value, 1e-6);  // the elastic value of a feasible plan
    EXPECT_EQ(run.continuous, row.plan.continuous);
  }
}

}  // namespace
}  // namespace maxwrench
