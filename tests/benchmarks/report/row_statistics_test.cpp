#include "benchmarks/report/row_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/report/benchmark_sets.h"
#include "benchmarks/report/differences.h"

namespace maxwrench {
namespace {

ResultRow row(const std::string& problem, const std::string& solver, const std::string& search,
              std::optional<double> beta, double us, std::uint64_t seed = 1) {
  ResultRow row;
  row.choice.problem = problem;
  row.choice.solver = solver;
  row.choice.search = search;
  row.choice.seed = seed;
  row.status = beta ? "best_found" : "infeasible";
  row.unit = "N";
  row.reason = beta ? "" : "why";
  row.beta = beta;
  row.us = us;
  return row;
}

/// Two tasks with two solvers each; one row has no value, one comes from a search of its own.
std::vector<ResultRow> five_rows() {
  return {row("f/a", "ours", "s", 10, 1), row("f/a", "peer", "s", 9.995, 4),
          row("g/b", "ours", "s", -2, 2), row("g/b", "peer", "s", {}, 6),
          row("g/b", "ours", "t", -4, 2)};
}

TEST(Summaries, Tasks) {
  const std::vector<TaskSummary> tasks = summarise_tasks(five_rows());
  ASSERT_EQ(tasks.size(), 2U);
  EXPECT_EQ(tasks[1].choice.problem, "g/b");
  EXPECT_EQ(tasks[1].rows, 3);
  EXPECT_EQ(tasks[1].solved, 2);
  EXPECT_EQ(tasks[1].best, -2);
  EXPECT_EQ(tasks[1].choice.search, "s");
}

/// s: 10 and -2 are best, 9.995 is 0.05 % below, one fails. t: -4 is 100 % below -2.
TEST(Summaries, Searches) {
  const std::vector<SearchSummary> all = summarise_searches(five_rows());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].search, "s");
  EXPECT_EQ(all[0].rows, 4);
  EXPECT_EQ(all[0].solved, 3);
  EXPECT_EQ(all[0].near, 3);
  EXPECT_NEAR(all[0].below, 2.5e-4, 1e-12);  // of 0, 0, 5e-4 and infinity
  EXPECT_DOUBLE_EQ(all[0].us, 3);
  EXPECT_EQ(all[1].below, 1);
}

TEST(Summaries, CostsAndFailures) {
  const std::vector<CostSummary> costs = summarise_costs(five_rows());
  ASSERT_EQ(costs.size(), 4U);
  EXPECT_EQ(costs[2].problem, "g/b");
  EXPECT_EQ(costs[2].rows, 2);
  EXPECT_EQ(costs[2].us, 2);
  EXPECT_TRUE(std::isnan(costs[2].us_low));
  const std::vector<FailureSummary> failures = summarise_failures(five_rows());
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].reason, "why");
  EXPECT_EQ(failures[0].rows, 1);
}

TEST(Summaries, OfNothing) {
  EXPECT_TRUE(summarise_tasks({}).empty());
  EXPECT_TRUE(summarise_searches({}).empty());
  EXPECT_TRUE(summarise_costs({}).empty());
  EXPECT_TRUE(summarise_failures({}).empty());
  EXPECT_TRUE(solver_benchmark_sets({}).empty());
  EXPECT_TRUE(race_groups({}).empty());
}

/// An interrupted search has a value and has failed.
TEST(Summaries, InterruptedIsNotSolved) {
  ResultRow interrupted = row("f/a", "ours", "s", 10, 1);
  interrupted.status = "budget_exhausted";
  EXPECT_FALSE(interrupted.solved());
  EXPECT_EQ(summarise_failures({interrupted}).size(), 1U);
}

/// The search t has one solver only and is no benchmark set; the peer fails on the second instance.
TEST(BenchmarkSets, SolversOnTheSameInstances) {
  const std::vector<BenchmarkSet> benchmark_sets = solver_benchmark_sets(five_rows());
  ASSERT_EQ(benchmark_sets.size(), 1U);
  EXPECT_EQ(benchmark_sets[0].methods, (std::vector<std::string>{"ours", "peer"}));
  EXPECT_EQ(benchmark_sets[0].cost[0], (std::vector<double>{1, 2}));
  EXPECT_EQ(benchmark_sets[0].cost[1], (std::vector<double>{4, kInfinity}));
}

/// Experiments are no searches, and their times are those of all their evaluations.
TEST(BenchmarkSets, ExperimentsStandApart) {
  std::vector<ResultRow> rows = five_rows();
  for (const auto& [integrator, us] : {std::pair{"cvode", 2.0}, {"ida", 0.5}}) {
    ResultRow& more = rows.emplace_back(row("f/a", "ours", "", 20, us));
    more.choice.integrator = integrator;
    more.status = "reached";
    more.evaluations = integrator == std::string("ida") ? 8000 : 1000;
  }
  const std::vector<BenchmarkSet> benchmark_sets = integrator_benchmark_sets(rows);
  ASSERT_EQ(benchmark_sets.size(), 1U);
  EXPECT_EQ(benchmark_sets[0].methods, (std::vector<std::string>{"cvode", "ida"}));
  EXPECT_EQ(benchmark_sets[0].cost, (std::vector<std::vector<double>>{{2}, {4}}));
  EXPECT_TRUE(integrator_benchmark_sets(five_rows()).empty());
  EXPECT_EQ(summarise_tasks(rows)[0].best, 10);
  EXPECT_EQ(summarise_searches(rows).size(), 2U);
  EXPECT_EQ(solver_benchmark_sets(rows)[0].instances(),
            solver_benchmark_sets(five_rows())[0].instances());
}

/// A third solver was not tried on the search t of f/a, which therefore is no instance; that it has
/// no row of g/b at all is its failure.
TEST(BenchmarkSets, WhatWasNotTriedIsNoFailure) {
  std::vector<ResultRow> rows = five_rows();
  rows.push_back(row("f/a", "third", "s", 10, 9));
  rows.push_back(row("f/a", "ours", "t", 10, 9));
  rows.push_back(row("f/a", "peer", "t", 10, 9));
  const std::vector<BenchmarkSet> benchmark_sets = solver_benchmark_sets(rows);
  ASSERT_EQ(benchmark_sets[0].methods.size(), 3U);
  EXPECT_EQ(benchmark_sets[0].cost[0], (std::vector<double>{1, 2}));
  EXPECT_EQ(benchmark_sets[0].cost[1], (std::vector<double>{4, kInfinity}));
  EXPECT_EQ(benchmark_sets[0].cost[2], (std::vector<double>{9, kInfinity}));
}

/// A solver that throws has no time, and has failed.
TEST(BenchmarkSets, AFailureNeedsNoTime) {
  std::vector<ResultRow> rows = five_rows();
  rows[3].us = std::nullopt;
  EXPECT_EQ(solver_benchmark_sets(rows)[0].cost[1], (std::vector<double>{4, kInfinity}));
  rows[1].us = std::nullopt;  // has a value and was not measured: no instance
  EXPECT_EQ(solver_benchmark_sets(rows)[0].cost[1], (std::vector<double>{kInfinity}));
}

TEST(BenchmarkSets, TheLargestBudgetCounts) {
  std::vector<ResultRow> rows = five_rows();
  rows.push_back(row("f/a", "peer", "s", 10, 3));
  rows.back().choice.budget = 40000;
  EXPECT_EQ(solver_benchmark_sets(rows)[0].cost[1][0], 3);
}

Comparison race(const std::string& problem, bool in_time, double first, double second) {
  Comparison race{problem, "N", {}, {}, "a", in_time, 100};
  for (const auto& [search, ms] : {std::pair{"a", first}, {"b", second}}) {
    Contender contender{search, "ours", 100, {}};
    Attempt attempt;
    attempt.value = 1;
    attempt.run.rises = {{{10, 1e-3 * ms}, 1}};
    attempt.run.spent = {100, 1};
    contender.attempts = {attempt};
    race.contenders.push_back(contender);
  }
  return race;
}

/// What has fewer seeds than others failed on the rest; several defaults are no reference.
TEST(BenchmarkSets, RacesOfDifferentSeeds) {
  std::vector<Comparison> races = {race("f/a", false, 1, 2), race("f/b", false, 4, 2)};
  for (const std::uint64_t seed : {2, 3}) {
    races[0].contenders[0].attempts.push_back(races[0].contenders[0].attempts[0]);
    races[0].contenders[0].attempts.back().choice.seed = seed;
  }
  races[1].default_search = "b";
  const BenchmarkSet benchmark_set = search_benchmark_set({"f", races});
  const std::size_t a = benchmark_set.methods[0] == "a" ? 0 : 1;
  EXPECT_EQ(benchmark_set.cost[a], (std::vector<double>{1, 1, 1, 4}));
  EXPECT_EQ(benchmark_set.cost[1 - a], (std::vector<double>{2, kInfinity, kInfinity, 2}));
  EXPECT_EQ(benchmark_set.reference, "");
  EXPECT_EQ(stand(benchmark_set).size(), 2U);
}

TEST(BenchmarkSets, RacesByFamily) {
  const std::vector<RaceGroup> groups =
      race_groups({race("f/a", false, 1, 2), race("f/b", false, 4, 2), race("g/a", false, 1, 3),
                   race("f/turn", true, 1, 1)});
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].races.size(), 3U);
  EXPECT_EQ(groups[1].title, "f");
  EXPECT_EQ(groups[1].races.size(), 2U);
  EXPECT_EQ(groups[3].title, "tasks in time");
  const BenchmarkSet benchmark_set = search_benchmark_set(groups[1]);
  ASSERT_EQ(benchmark_set.methods.size(), 2U);
  const std::size_t a = benchmark_set.methods[0] == "a" ? 0 : 1;
  EXPECT_EQ(benchmark_set.cost[a], (std::vector<double>{1, 4}));
}

TEST(Differences, ValuesTimesAndRowsOfOneSide) {
  Results a, b;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    a.rows.push_back(row("f/a", "ours", "s", 10, 1, seed));
    b.rows.push_back(row("f/a", "ours", "s", 10, 2, seed));
  }
  b.rows[0].beta = 10 + 1e-12;
  b.rows[1].beta = 10.1;
  b.rows[2].beta = {};
  a.rows.push_back(row("f/a", "ours", "old", 1, 1));
  b.rows.push_back(row("f/a", "ours", "new", 1, 1));
  const Differences changes = find_differences(a, b);
  EXPECT_EQ(changes.same, 5);
  EXPECT_EQ(changes.rounded, 1);
  ASSERT_EQ(changes.changed.size(), 2U);
  EXPECT_EQ(changes.changed[0].b->beta, 10.1);
  ASSERT_EQ(changes.only_a.size(), 1U);
  EXPECT_EQ(changes.only_a[0]->choice.search, "old");
  ASSERT_EQ(changes.only_b.size(), 1U);
  ASSERT_EQ(changes.times.size(), 4U);  // all rows, one solver, one search, one problem
  EXPECT_EQ(changes.times[0].rows, 8);
  EXPECT_EQ(changes.times[0].times, 2);
  EXPECT_TRUE(changes.times[0].is_significant());  // p is 4 times 2/2^8
  EXPECT_DOUBLE_EQ(changes.times[0].p, 4 * 2.0 / 256);
}

/// Readings hang on steps; that one was held and the other was not is a change at any reading.
TEST(Differences, Experiments) {
  Results a;
  for (const char* problem : {"f/a", "g/b", "h/c"}) {
    a.rows.push_back(row(problem, "ours", "", 100, 1));
    a.rows.back().choice.integrator = "cvode";
    a.rows.back().status = "reached";
    a.rows.back().evaluations = 1000;
  }
  Results b = a;
  b.rows[0].beta = 100.005;  // 5e-5 of 101
  b.rows[1].beta = 100.02;   // 2e-4
  b.rows[2].reason = "reading off by 3";
  const Differences changes = find_differences(a, b);
  EXPECT_EQ(changes.same, 0);
  EXPECT_EQ(changes.rounded, 1);
  ASSERT_EQ(changes.changed.size(), 2U);
  EXPECT_EQ(changes.changed[0].b->beta, 100.02);
  EXPECT_EQ(changes.changed[1].b->reason, "reading off by 3");
  ASSERT_FALSE(changes.times.empty());
  EXPECT_EQ(changes.times.back().name, "cvode");
}

TEST(Differences, AFolderAndItself) {
  Results a;
  a.rows = five_rows();
  const Differences changes = find_differences(a, a);
  EXPECT_EQ(changes.same, 5);
  EXPECT_TRUE(changes.changed.empty());
  for (const TimeRatio& time : changes.times) EXPECT_FALSE(time.is_significant());
}

}  // namespace
}  // namespace maxwrench
