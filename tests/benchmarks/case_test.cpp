#include "benchmarks/case.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "problems/loader.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

TEST(Case, DefaultsToTheFirstSolverThatServes) {
  EXPECT_EQ(complete({"p", "linf_polytope", Wrench::kPure}).lp, "facets");
  EXPECT_NE(complete({"p", "linf_polytope", Wrench::kAny}).lp, "facets");
  EXPECT_EQ(complete({"p", "ellipsoid", Wrench::kAny}).lp, kNoSolver);
}

TEST(Case, RefusesChoicesWithoutMeaning) {
  EXPECT_THROW(complete({"p", "linf_polytope", Wrench::kAny, "facets"}), std::invalid_argument);
  EXPECT_THROW(complete({"p", "ellipsoid", Wrench::kPure, "simplex"}), std::invalid_argument);
  EXPECT_THROW(complete({"p", "linf_polytope", Wrench::kPure, kNoSolver}), std::invalid_argument);
  EXPECT_THROW(complete({"p", "manipulability", Wrench::kAny}), std::invalid_argument);
  EXPECT_THROW(complete({"p", "volume", Wrench::kPure}), std::invalid_argument);
  EXPECT_THROW(complete({"p", "ellipsoid", Wrench::kPure, "", "magic"}), std::invalid_argument);
  EXPECT_THROW(complete({"p", "ellipsoid", Wrench::kPure, "", "grid", 1, 0}),
               std::invalid_argument);
  EXPECT_THROW(parse_wrench("both"), std::invalid_argument);
}

TEST(Case, ClosedFormsRefuseLimitedContacts) {
  Problem problem = load_problem("planar/two_arms");
  const auto made = [&](const char* measure) {
    measure_maker(problem, complete({problem.name, measure}, problem.contact_columns()))();
  };
  EXPECT_NO_THROW(made("ellipsoid"));
  problem.contact->w_max[0] = 5;
  EXPECT_THROW(made("ellipsoid"), std::invalid_argument);
  EXPECT_THROW(made("least_effort"), std::invalid_argument);
  EXPECT_NO_THROW(made("linf_polytope"));
  EXPECT_NO_THROW(made("manipulability"));
}

TEST(Case, ProductHoldsEachMeaningfulCombinationOnce) {
  const std::vector<Case> cases = product("p", 3, 100);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_NO_THROW(complete(cases[i]));
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(case_values(cases[i]), case_values(cases[j]));
  }
}

TEST(Case, ProductCrossesEverySearchAndEverySolverWithoutCrossingBoth) {
  const std::vector<Case> cases = product("p", 1, 100);
  for (const SearchEntry& search : searches())
    EXPECT_FALSE(select(cases, {{"search", search.name}, {"lp", "facets"}}).empty());
  for (const WrenchSolverEntry& solver : wrench_solvers())
    EXPECT_FALSE(select(cases, {{"search", searches()[0].name}, {"lp", solver.name}}).empty());
  EXPECT_THROW(select(cases, {{"search", "multistart"}, {"lp", "ipopt"}}), std::invalid_argument);
}

TEST(Case, SelectKeepsWhatMatches) {
  const std::vector<Case> cases = product("p", 1, 100);
  for (const Case& c : select(cases, {{"measure", "ellipsoid"}, {"wrench", "any"}})) {
    EXPECT_EQ(c.measure, "ellipsoid");
    EXPECT_EQ(c.wrench, Wrench::kAny);
  }
  EXPECT_EQ(select(cases, {{"seed", "5"}}).size(), cases.size());
  EXPECT_THROW(select(cases, {{"colour", "red"}}), std::invalid_argument);
  EXPECT_THROW(select(cases, {{"measure", "ellipsoid"}, {"lp", "facets"}}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
