#include "benchmarks/race/race_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "benchmarks/race/race_summary.h"
#include "benchmarks/suite/results.h"
#include "benchmarks/tables/csv.h"
#include "cli/suite/race_table.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Files hold seconds with four digits.
void expect_near_or_both_never(double a, double b, const std::string& what) {
  if (std::isfinite(a) && std::isfinite(b)) {
    EXPECT_NEAR(a, b, 1e-3 * std::abs(a)) << what;
  } else {
    EXPECT_EQ(a, b) << what;
  }
}

void expect_same_contenders(const Comparison& race, const std::vector<Contender>& written,
                            const std::vector<Contender>& read) {
  ASSERT_EQ(read.size(), written.size());
  for (const Contender& before : written) {
    const auto after = std::find_if(read.begin(), read.end(), [&](const Contender& each) {
      return each.search == before.search && each.solver == before.solver;
    });
    ASSERT_NE(after, read.end()) << before.search;
    EXPECT_EQ(after->attempts.size(), before.attempts.size());
    EXPECT_EQ(after->budget, before.budget);
    for (const double share : kTargetShares) {
      for (const Cost cost : {&Spent::evaluations, &Spent::seconds}) {
        expect_near_or_both_never(before.expected(race.target(share), cost),
                                  after->expected(race.target(share), cost), before.search);
      }
    }
  }
}

Comparison small_race(const Problem& problem, long budget) {
  Case base;
  base.problem = problem.name;
  base.search = default_search(problem, base.measure);
  base.budget = budget;
  RaceOptions options;
  options.seeds = 3;
  return compare(problem, base, options);
}

/// What `compare` knows of a race, its files know, too.
TEST(RaceFile, ARaceComesBack) {
  const Problem problem = load_problem("planar/force");
  const Comparison race = small_race(problem, 300);
  const TemporaryFolder folder;
  keep(race, folder.path());
  const std::vector<Comparison> read = read_races(folder.path());
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].problem, race.problem);
  EXPECT_EQ(read[0].unit, race.unit);
  EXPECT_EQ(read[0].default_search, race.default_search);
  EXPECT_EQ(read[0].proven, race.proven);
  EXPECT_EQ(read[0].best(), race.best());
  EXPECT_EQ(read[0].in_time, race.in_time);
  expect_same_contenders(race, race.contenders, read[0].contenders);
  expect_same_contenders(race, race.peers, read[0].peers);
  const auto before = standings({&race, 1}), after = standings(read);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < kTargetShares.size(); ++i) {
    EXPECT_EQ(after.front().reached[i], before.front().reached[i]);
  }
}

TEST(RaceFile, ALaterRaceTakesThePlaceOfAnEarlierOne) {
  const Problem problem = load_problem("planar/force");
  const TemporaryFolder folder;
  keep(small_race(problem, 300), folder.path());
  const Comparison later = small_race(problem, 200);
  keep(later, folder.path());
  const std::vector<Comparison> read = read_races(folder.path());
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].budget, 200);
  expect_same_contenders(later, later.contenders, read[0].contenders);
}

TEST(RaceFile, RowsOfTwoRacesAreRejected) {
  const Problem problem = load_problem("planar/force");
  const TemporaryFolder folder;
  const Comparison race = small_race(problem, 200);
  keep(race, folder.path());
  const auto file = folder.path() / "search_comparison.csv.gz";
  const std::string good = csv_text(file);
  const std::size_t last = good.rfind('\n', good.size() - 2) + 1;
  const auto rejected = [&](const std::string& text) {
    std::ofstream(file) << text;
    try {
      read_races(folder.path());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(rejected(good), "");
  std::string line = good.substr(last);
  const std::string best = fmt::format("{:.17g}", race.best());
  ASSERT_NE(line.find(best), std::string::npos);
  EXPECT_NE(rejected(good.substr(0, last) + line.replace(line.find(best), best.size(), "9"))
                .find("best_known: got '9', expected " + best),
            std::string::npos);
  line = good.substr(last);
  ASSERT_NE(line.find(",200,"), std::string::npos);
  EXPECT_NE(rejected(good + line.replace(line.find(",200,"), 5, ",100,"))
                .find("budget: got '100', expected one of each search"),
            std::string::npos);
}

/// A folder with values.csv as `run` writes it, of two rows.
class ResultsFolder : public testing::Test {
 protected:
  ResultsFolder() {
    write("values.csv", kHeader + kFirst + kSecond);
    write("times.csv", kTimesHeader + kCase + ",100,0.5,0.25\n");
  }
  void write(const std::string& file, const std::string& text) {
    std::ofstream(folder_.path() / file) << text;
  }
  std::string complaint() {
    try {
      read_results(folder_.path());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(folder_.path().string().size() + 1);
    }
    return "";
  }

  const std::string kKeys = "problem,measure,wrench,solver,search,seed,budget,scheme,integrator";
  const std::string kHeader = kKeys + ",status,beta,unit,beta_linf,evaluations,reason\n";
  const std::string kTimesHeader = kKeys + ",evaluations,wall_s,cpu_s\n";
  const std::string kCase = "f/a,linf_polytope,pure,facets,cmaes,1,100,,";
  const std::string kFirst = kCase + ",best_found,2.5,N,,100,\n";
  const std::string kSecond =
      "f/a,linf_polytope,any,box,cmaes,2,100,,,infeasible,,N,,100,\"no, never\"\n";
  TemporaryFolder folder_;
};

TEST_F(ResultsFolder, RowsWithTheirTimes) {
  const Results results = read_results(folder_.path());
  ASSERT_EQ(results.rows.size(), 2U);
  EXPECT_TRUE(results.rows[0].solved());
  EXPECT_EQ(results.rows[0].beta, 2.5);
  EXPECT_DOUBLE_EQ(*results.rows[0].us, 2500);  // of the processor's 0.25 s
  EXPECT_FALSE(results.rows[1].solved());
  EXPECT_EQ(results.rows[1].reason, "no, never");
  EXPECT_EQ(results.rows[1].choice.wrench, Wrench::kAny);
  EXPECT_FALSE(results.rows[1].us);
  EXPECT_TRUE(results.races.empty());
}

/// Wall times beside processor times would compare threads.
TEST_F(ResultsFolder, NoTimesWhereTheProcessorWasNotMeasured) {
  write("times.csv", kKeys + ",evaluations,wall_s\n" + kCase + ",100,0.5\n");
  EXPECT_FALSE(read_results(folder_.path()).rows[0].us);
}

TEST_F(ResultsFolder, NoRows) {
  write("values.csv", kHeader);
  EXPECT_TRUE(read_results(folder_.path()).rows.empty());
}

TEST_F(ResultsFolder, NamesWhatIsWrong) {
  write("values.csv", kHeader + kFirst + kFirst);
  EXPECT_EQ(
      complaint(),
      "values.csv: line 3: problem: got 'f/a', expected each case once: line 2 has it already");
  write("values.csv", kHeader + kCase + ",best_found,nan,N,,100,\n");
  EXPECT_EQ(complaint(),
            "values.csv: line 2: beta: got 'nan', expected a finite number or nothing");
  write("values.csv",
        kHeader + "f/a,linf_polytope,pure,facets,cmaes,-1,100,,,best_found,1,N,,1,\n");
  EXPECT_EQ(complaint(), "values.csv: line 2: seed: got '-1', expected a whole number");
  write("values.csv", kHeader + "f/a,linf_polytope,both,facets,cmaes,1,100,,,best_found,1,N,,1,\n");
  EXPECT_EQ(complaint(), "values.csv: line 2: wrench: got 'both', expected pure or any");
  write("values.csv", kKeys + ",status\n");
  EXPECT_EQ(complaint(), "values.csv: line 1: got no column 'beta', expected one");
  write("values.csv", kHeader + kFirst);
  write("search_comparison.csv", "problem\n");
  EXPECT_EQ(complaint(), "search_comparison.csv: line 1: got no column 'measure', expected one");
}

}  // namespace
}  // namespace maxwrench
