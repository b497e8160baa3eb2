#include "benchmarks/suite/cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "benchmarks/tables/table.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/row.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Cost, ShardsShareTheCasesEvenly) {
  std::vector<Case> cases(50);
  std::vector<double> costs;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].seed = i;
    costs.push_back(static_cast<double>(1 + i % 7));
  }
  std::multiset<std::uint64_t> seen;
  double least = 1e9, most = 0;
  for (int index = 0; index < 3; ++index) {
    double sum = 0;
    for (const Case& c : shard(cases, costs, index, 3)) {
      seen.insert(c.seed);
      sum += costs[c.seed];
    }
    least = std::min(least, sum);
    most = std::max(most, sum);
  }
  EXPECT_EQ(seen.size(), 50U);
  EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), 50U);
  EXPECT_LE(most - least, 1);  // the last to be placed cost 1
}

/// A library for one thread at a time counts wherever it is named.
TEST(Cost, CasesOfOneLibraryWaitForEachOther) {
  EXPECT_FALSE(waits_for_others({.solver = "facets", .search = "sample+cmaes"}));
  if (std::none_of(lp_solvers().begin(), lp_solvers().end(),
                   [](const LpEntry& lp) { return lp.name == std::string("ipopt"); })) {
    GTEST_SKIP() << "without Ipopt";
  }
  EXPECT_TRUE(waits_for_others({.solver = "ipopt", .search = "sample"}));
  EXPECT_TRUE(waits_for_others({.solver = "facets", .search = "grid+multistart"}));
}

/// 3 s and 5 s of 100 evaluations each are 4 s of 100 and 8 s of 200, whatever the seed.
TEST(Cost, WhatWasMeasuredCounts) {
  const TemporaryFolder folder;
  const Problem problem = load_problem("planar/force");
  Case c{.problem = problem.name, .solver = "facets", .search = "sample", .budget = 100};
  std::vector<std::string> columns = case_columns();
  columns.emplace_back("cpu_s");
  Table times(folder.path() / "times.csv", columns, case_columns().size());
  EXPECT_EQ(Forecast(times).seconds(problem, c), usual_seconds(problem, c));
  for (const char* seconds : {"3", "5"}) {
    std::vector<std::string> row = case_values(c);
    row.emplace_back(seconds);
    times.add(row);
    ++c.seed;
  }
  c.budget = 200;
  EXPECT_DOUBLE_EQ(Forecast(times).seconds(problem, c), 8);
  c.search = "grid";
  EXPECT_EQ(Forecast(times).seconds(problem, c), usual_seconds(problem, c));
}

}  // namespace
}  // namespace maxwrench
