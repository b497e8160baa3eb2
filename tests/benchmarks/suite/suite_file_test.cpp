#include "benchmarks/suite/suite_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Workload read_plan_text(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "plan.toml") << text;
  return read_plan_file(folder.path() / "plan.toml");
}

TEST(PlanFile, ColumnsThatAreMissingAreTheDefaults) {
  const Workload work = read_plan_text("[[product]]\nproblem = 'planar/force'\n");
  ASSERT_EQ(work.cases.size(), 1U);
  const Case& c = work.cases.front();
  EXPECT_EQ(c.measure, "linf_polytope");
  EXPECT_EQ(c.wrench, Wrench::kPure);
  EXPECT_EQ(c.lp, "facets");
  EXPECT_EQ(c.search, default_search(work.problems.at("planar/force"), c.measure));
  EXPECT_EQ(c.seed, 1U);
  EXPECT_EQ(c.budget, kUsualBudget);
}

/// pure: every solver; any: all but the one of one column. Budgets are divided by the cost.
TEST(PlanFile, WhatHasNoMeaningIsLeftOut) {
  const Workload work = read_plan_text(
      "[[product]]\nproblem = 'planar/force'\nwrench = 'all'\nlp = 'all'\n"
      "search = ['grid', 'slp+cmaes']\nseeds = 3\nbudget = 1000\n");
  const std::size_t solvers = wrench_solvers().size();
  EXPECT_EQ(work.cases.size(), (2 * solvers - 1) * 2 * 3);
  for (const Case& c : work.cases) {
    EXPECT_FALSE(c.wrench == Wrench::kAny && c.lp == "facets");
    EXPECT_EQ(c.budget, 1000 / find_wrench_solver(c.lp).cost);
  }
}

/// Two products may have rows in common.
TEST(PlanFile, EachRowStandsOnce) {
  const std::string product =
      "[[product]]\nproblem = ['planar/trajectory', 'planar/force']\nscheme = 'all'\n";
  EXPECT_EQ(read_plan_text(product + product).cases.size(), read_plan_text(product).cases.size());
}

/// Of two wrenches two integrators each, without a search; a second contact has no experiment, nor
/// has a measure that is no wrench.
TEST(PlanFile, ExperimentsSearchNothing) {
  const Workload work = read_plan_text(
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

struct BadPlanFile {
  const char *text, *complaint;
};

class BadPlanFiles : public testing::TestWithParam<BadPlanFile> {};

TEST_P(BadPlanFiles, AreRefusedInOneLine) {
  try {
    read_plan_text(GetParam().text);
    FAIL() << GetParam().text;
  } catch (const std::invalid_argument& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("plan.toml: "), std::string::npos) << line;
    EXPECT_NE(line.find(GetParam().complaint), std::string::npos) << line;
    EXPECT_NE(line.find("expected "), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadPlanFiles,
    testing::Values(
        BadPlanFile{"", "product: got nothing"},
        BadPlanFile{"rows = 3", "rows: got an unknown key"},
        BadPlanFile{"[[product]]", "product[0].problem: got nothing"},
        BadPlanFile{"[[product]]\nproblem='a/b'", "product[0].problem: got 'a/b'"},
        BadPlanFile{"[[product]]\nproblem='all'\nmeasure='x'", "product[0].measure: got 'x'"},
        BadPlanFile{"[[product]]\nproblem='all'\nlp=['box','x']", "product[0].lp: got 'x'"},
        BadPlanFile{"[[product]]\nproblem='all'\nlp=[]", "product[0].lp: got []"},
        BadPlanFile{"[[product]]\nproblem='all'\nsearch='x'", "product[0].search: got 'x'"},
        BadPlanFile{"[[product]]\nproblem='all'\nscheme=3", "product[0].scheme: got 3"},
        BadPlanFile{"[[product]]\nproblem='all'\nintegrator='arkode'",
                    "product[0].integrator: got 'arkode', expected \"all\" or some of cvode ida"},
        BadPlanFile{"[[product]]\nproblem='all'\nintegrator='ida'\nsearch='grid'",
                    "product[0].search: got 'grid', expected no such key beside integrator"},
        BadPlanFile{"[[product]]\nproblem='dual_arm/two_arms'\nintegrator='ida'",
                    "mean nothing together"},
        BadPlanFile{"[[product]]\nproblem='all'\nseeds=0", "product[0].seeds: got 0"},
        BadPlanFile{"[[product]]\nproblem='all'\nbudget=1.5", "product[0].budget: got 1.5"},
        BadPlanFile{"[[product]]\nproblem='all'\ncolour='x'", "product[0].colour: got an unknown"},
        BadPlanFile{"[[product]]\nproblem='planar/force'\nwrench='any'\nlp='facets'",
                    "mean nothing together"}));

}  // namespace
}  // namespace maxwrench
