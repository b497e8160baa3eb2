#include "benchmarks/suite/suite_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Workload read_suite_text(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "suite.toml") << text;
  return read_suite_file(folder.path() / "suite.toml");
}

TEST(SuiteFile, ColumnsThatAreMissingAreTheDefaults) {
  const Workload work = read_suite_text("[[product]]\nproblem = 'planar/force'\n");
  ASSERT_EQ(work.cases.size(), 1U);
  const Case& c = work.cases.front();
  EXPECT_EQ(c.measure, "linf_polytope");
  EXPECT_EQ(c.wrench, Wrench::kPure);
  EXPECT_EQ(c.solver, "facets");
  EXPECT_EQ(c.search, default_search(work.problems.at("planar/force"), c.measure));
  EXPECT_EQ(c.seed, 1U);
  EXPECT_EQ(c.budget, kUsualBudget);
}

/// pure: every solver; any: all but the one of one column. Budgets are divided by the cost.
TEST(SuiteFile, WhatHasNoMeaningIsLeftOut) {
  const Workload work = read_suite_text(
      "[[product]]\nproblem = 'planar/force'\nwrench = 'all'\nsolver = 'all'\n"
      "search = ['grid', 'slp+cmaes']\nseeds = 3\nbudget = 1000\n");
  const std::size_t solvers = wrench_solvers().size();
  EXPECT_EQ(work.cases.size(), (2 * solvers - 1) * 2 * 3);
  for (const Case& c : work.cases) {
    EXPECT_FALSE(c.wrench == Wrench::kAny && c.solver == "facets");
    EXPECT_EQ(c.budget, 1000 / find_wrench_solver(c.solver).cost);
  }
}

/// Two products may have rows in common.
TEST(SuiteFile, EachRowStandsOnce) {
  const std::string product =
      "[[product]]\nproblem = ['planar/trajectory', 'planar/force']\nscheme = 'all'\n";
  EXPECT_EQ(read_suite_text(product + product).cases.size(), read_suite_text(product).cases.size());
}

/// Of two wrenches two integrators each, without a search; a second contact has no experiment, nor
/// has a measure that is no wrench.
TEST(SuiteFile, ExperimentsSearchNothing) {
  const Workload work = read_suite_text(
      "[[product]]\nproblem = ['planar/force', 'dual_arm/bar_wall']\nwrench = 'all'\n"
      "measure = ['linf_polytope', 'manipulability']\nintegrator = ['cvode', 'ida']\n");
  ASSERT_EQ(work.cases.size(), 4U);
  for (const Case& c : work.cases) {
    EXPECT_EQ(c.problem, "planar/force");
    EXPECT_EQ(c.measure, "linf_polytope");
    EXPECT_EQ(c.search, "");
    EXPECT_TRUE(c.integrator == "cvode" || c.integrator == "ida");
  }
}

struct BadSuiteFile {
  const char *text, *complaint;
};

class BadSuiteFiles : public testing::TestWithParam<BadSuiteFile> {};

TEST_P(BadSuiteFiles, AreRejectedInOneLine) {
  try {
    read_suite_text(GetParam().text);
    FAIL() << GetParam().text;
  } catch (const std::invalid_argument& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("suite.toml: "), std::string::npos) << line;
    EXPECT_NE(line.find(GetParam().complaint), std::string::npos) << line;
    EXPECT_NE(line.find("expected "), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSuiteFiles,
    testing::Values(
        BadSuiteFile{"", "product: got nothing"},
        BadSuiteFile{"rows = 3", "rows: got an unknown key"},
        BadSuiteFile{"[[product]]", "product[0].problem: got nothing"},
        BadSuiteFile{"[[product]]\nproblem='a/b'", "product[0].problem: got 'a/b'"},
        BadSuiteFile{"[[product]]\nproblem='all'\nmeasure='x'", "product[0].measure: got 'x'"},
        BadSuiteFile{"[[product]]\nproblem='all'\nsolver=['condensed','x']",
                     "product[0].solver: got 'x'"},
        BadSuiteFile{"[[product]]\nproblem='all'\nsolver=[]", "product[0].solver: got []"},
        BadSuiteFile{"[[product]]\nproblem='all'\nsearch='x'", "product[0].search: got 'x'"},
        BadSuiteFile{"[[product]]\nproblem='all'\nscheme=3", "product[0].scheme: got 3"},
        BadSuiteFile{"[[product]]\nproblem='all'\nintegrator='arkode'",
                     "product[0].integrator: got 'arkode', expected \"all\" or some of cvode ida"},
        BadSuiteFile{"[[product]]\nproblem='all'\nintegrator='ida'\nsearch='grid'",
                     "product[0].search: got 'grid', expected no such key beside integrator"},
        BadSuiteFile{"[[product]]\nproblem='dual_arm/two_arms'\nintegrator='ida'",
                     "a combination of columns that is not valid"},
        BadSuiteFile{"[[product]]\nproblem='all'\nseeds=0", "product[0].seeds: got 0"},
        BadSuiteFile{"[[product]]\nproblem='all'\nbudget=1.5", "product[0].budget: got 1.5"},
        BadSuiteFile{"[[product]]\nproblem='all'\ncolour='x'", "product[0].colour: got an unknown"},
        BadSuiteFile{"[[product]]\nproblem='planar/force'\nwrench='any'\nsolver='facets'",
                     "a combination of columns that is not valid"}));

}  // namespace
}  // namespace maxwrench
