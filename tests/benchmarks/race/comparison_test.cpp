#include "benchmarks/race/comparison.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

/// Of all searches that support the task: every evaluation passes the clock, of values or of
/// something else, so that what was spent when a value rose is counted as the budget is.
TEST(Comparison, ClockCountsWhatTheSearchCounts) {
  const Problem problem = load_problem("planar/force");
  for (const auto& table : {searches(), trajectory_searches(), facet_searches()}) {
    for (const SearchEntry& entry : table) {
      SCOPED_TRACE(entry.name);
      const Case c{problem.name, "linf_polytope", Wrench::kPure, "", entry.name, 1, 300};
      const Method method = resolve(problem, c);
      const Attempt run = attempt(problem, method);
      ASSERT_FALSE(run.run.rises.empty());
      EXPECT_EQ(run.run.rises.back().value, run.value);
      EXPECT_LE(run.run.rises.back().at.evaluations, run.run.spent.evaluations);
      EXPECT_LE(run.run.rises.back().at.seconds, run.run.spent.seconds);
      EXPECT_EQ(run.counted, run.run.spent.evaluations);
      EXPECT_LE(run.run.spent.evaluations, 300);
      for (std::size_t i = 1; i < run.run.rises.size(); ++i) {
        EXPECT_GT(run.run.rises[i].at.evaluations, run.run.rises[i - 1].at.evaluations);
        EXPECT_GT(run.run.rises[i].value, run.run.rises[i - 1].value);
      }
    }
  }
}

/// No posture can be held; a trajectory search has seen values, with slack, that count for nothing.
TEST(Comparison, ValuesWithSlackAreNone) {
  Problem problem = load_problem("uvms/valve");
  add_body(problem.robot.links[0], 1000, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
  const Case c{problem.name, "linf_polytope", Wrench::kPure, "", "slp", 1, 60};
  const Attempt run = attempt(problem, resolve(problem, c));
  EXPECT_EQ(run.value, -kInfinity);
  EXPECT_GT(run.run.spent.evaluations, 0);
  EXPECT_EQ(first_hit(run.run, -1e9).evaluations, kInfinity);
}

/// Of a static task by linf_polytope those of trajectories and between facets too; then the plain
/// way through each peer that is built in.
TEST(Comparison, RacesTheSearchesThatSupportTheTask) {
  const Problem problem = load_problem("planar/force");
  const auto postures = static_cast<long>(searches().size()) + 1;  // and the default
  const auto trajectories = static_cast<long>(trajectory_searches().size());
  const auto facets = static_cast<long>(facet_searches().size());
  long peers = 0;
  for (const LpEntry& lp : lp_solvers()) {
    peers += lp.name == std::string("glpk") || lp.name == std::string("clp") ? 1 : 0;
  }
  Case c{.problem = problem.name};
  EXPECT_EQ(attempt_count(problem, c, 3), 3 * (postures + trajectories + facets + peers));
  c.measure = "ellipsoid";
  EXPECT_EQ(attempt_count(problem, c, 3), 3 * postures);
  c.measure = "linf_polytope";
  EXPECT_EQ(attempt_count(load_problem("planar/two_arms"), c, 1), postures + facets + peers);
}

/// The same attempts at any number of threads, in the order of the seeds; dear searches get a part
/// of the budget.
TEST(Comparison, SLOW_ThreadsDoNotChangeTheRace) {
  const Problem problem = load_problem("uvms/lift");
  const Case base{.problem = problem.name, .budget = 60};
  const Comparison one = compare(problem, base, {2, 1, true, {}});
  const Comparison four = compare(problem, base, {2, 4, true, {}});
  ASSERT_EQ(one.contenders.size(), four.contenders.size());
  for (std::size_t i = 0; i < one.contenders.size(); ++i) {
    const Contender &a = one.contenders[i], &b = four.contenders[i];
    SCOPED_TRACE(a.search);
    const bool dear =
        a.search == "multistart" || a.search == "facet_nlp" || a.search == "joint_nlp";
    EXPECT_EQ(a.budget, dear ? 12 : 60);
    ASSERT_EQ(a.attempts.size(), 2U);
    ASSERT_EQ(b.attempts.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(a.attempts[k].choice.seed, k + 1);
      EXPECT_EQ(a.attempts[k].value, b.attempts[k].value);
      ASSERT_EQ(a.attempts[k].run.rises.size(), b.attempts[k].run.rises.size());
      for (std::size_t r = 0; r < a.attempts[k].run.rises.size(); ++r) {
        EXPECT_EQ(a.attempts[k].run.rises[r].at.evaluations,
                  b.attempts[k].run.rises[r].at.evaluations);
      }
    }
  }
}

/// A proven bound, or what another run found, replaces the best of the attempts; the reference is
/// the peer that gets to the target sooner.
TEST(Comparison, TargetsAndReference) {
  Comparison comparison;
  EXPECT_EQ(comparison.reference(), nullptr);
  EXPECT_EQ(comparison.target(), kInfinity);
  for (const auto& [lp, seconds] : {std::pair("glpk", 3.0), std::pair("clp", 2.0)}) {
    Attempt attempt;
    attempt.value = 100;
    attempt.run = {{{{1, seconds}, 100}}, {1, seconds}};
    comparison.peers.push_back({"annealing+cmaes", lp, 1, {attempt}});
  }
  EXPECT_EQ(comparison.best(), 100);
  EXPECT_DOUBLE_EQ(comparison.target(), 99.9);
  EXPECT_EQ(comparison.reference()->solver, "clp");
  comparison.proven = 110;
  EXPECT_DOUBLE_EQ(comparison.target(0.1), 99);
  EXPECT_EQ(comparison.peers[0].expected(comparison.target(), &Spent::seconds), kInfinity);
  EXPECT_EQ(comparison.reference()->solver, "glpk");  // neither gets there: the first
}

/// Branch and bound closes on the planar optimum, which is proven elsewhere: 3.4775 to four digits.
/// Eleven coordinates are too many to be tried.
TEST(Comparison, TargetsLieBelowAProvenBound) {
  const RaceOptions one{1, 2, true, {}};
  Case c{"planar/force", "linf_polytope", Wrench::kPure, "", "facet_sqp+cmaes", 1, 500};
  const Comparison proven = compare(load_problem(c.problem), c, one);
  ASSERT_TRUE(proven.proven);
  EXPECT_EQ(proven.best(), *proven.proven);
  EXPECT_GE(*proven.proven, proven.best_found().value);
  EXPECT_LT(*proven.proven, proven.best_found().value * (1 + 4e-5));
  EXPECT_NEAR(*proven.proven, 3.4775, 1e-4);
  c.problem = "dual_arm/two_arms";
  EXPECT_FALSE(compare(load_problem(c.problem), c, one).proven);
}

/// Nothing that the clock sees is left out: its last rise is the answer of the search, which
/// maximises the value at the instants as all do, and so may have less between them than `solve`.
TEST(Comparison, ClockSeesTheBestValue) {
  const Problem problem = load_problem("planar/trajectory");
  for (const char* name : {"slp", "annealing"}) {
    SCOPED_TRACE(name);
    const Case c{problem.name, "linf_polytope", Wrench::kPure, "", name, 1, 200};
    Method method = resolve(problem, c);
    const Attempt run = attempt(problem, method);
    EXPECT_EQ(run.choice.scheme, "spline");
    ASSERT_FALSE(run.run.rises.empty());
    EXPECT_EQ(run.run.rises.back().value, run.value);
    EXPECT_LE(run.run.rises.back().at.seconds, run.run.spent.seconds);
    EXPECT_EQ(run.counted, run.run.spent.evaluations);
    EXPECT_LE(run.run.spent.evaluations, 200);
    method.trajectory_value = TrajectoryValue::kAtInstants;
    const auto objective = make_objective(problem, method);
    const SearchResult same = run_search(problem, method, *objective, {});
    EXPECT_EQ(run.value, same.value);
    EXPECT_EQ(run.run.spent.evaluations, static_cast<double>(same.evaluations));
    EXPECT_NEAR(run.value, objective->evaluate(same.theta_r), 1e-9);
  }
}

TEST(Comparison, RejectsOptionsOutOfRange) {
  const Problem problem = load_problem("planar/force");
  const Case base{.problem = problem.name, .budget = 10};
  expect_rejected("seeds", [&] { compare(problem, base, {0, 1, true, {}}); });
  expect_rejected("threads", [&] { compare(problem, base, {1, 0, true, {}}); });
}

}  // namespace
}  // namespace maxwrench
