#include "solvers/solve/method.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "benchmarks/suite/product.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

TEST(Method, DefaultsToTheFirstSolverThatSupportsIt) {
  Problem problem = load_problem("planar/force");
  const auto lp = [&](const char* measure, Wrench wrench) {
    return resolve(problem, {problem.name, measure, wrench}).choice.solver;
  };
  EXPECT_EQ(lp("linf_polytope", Wrench::kPure), "facets");
  EXPECT_EQ(lp("linf_polytope", Wrench::kAny), "condensed");
  EXPECT_EQ(lp("ellipsoid", Wrench::kAny), kNoSolver);
  problem.robot.actuation.has_facets = false;
  EXPECT_EQ(lp("linf_polytope", Wrench::kPure), "condensed");
}

TEST(Method, RejectsChoicesWithoutMeaning) {
  Problem problem = load_problem("planar/force");
  const auto rejected = [&](const Case& c) {
    EXPECT_THROW(resolve(problem, c), std::invalid_argument) << c.measure << " " << c.solver;
  };
  rejected({"p", "linf_polytope", Wrench::kAny, "facets"});
  rejected({"p", "ellipsoid", Wrench::kPure, "simplex"});
  rejected({"p", "linf_polytope", Wrench::kPure, kNoSolver});
  rejected({"p", "manipulability", Wrench::kAny});
  rejected({"p", "volume", Wrench::kPure});
  rejected({"p", "ellipsoid", Wrench::kPure, "", "magic"});
  rejected({"p", "ellipsoid", Wrench::kPure, "", "grid", 1, -1});
  EXPECT_THROW(parse_wrench("both"), std::invalid_argument);
  // An explicit choice is never replaced.
  problem.robot.actuation.has_facets = false;
  rejected({"p", "linf_polytope", Wrench::kPure, "facets"});
}

TEST(Method, KeepsNoProblemThatGoesAway) {
  static_assert(
      !std::is_invocable_v<decltype([](auto&& p) -> decltype(resolve(std::forward<decltype(p)>(p),
                                                                     Case{})) {}),
                           Problem>);
}

TEST(Method, ClosedFormsRejectLimitedContacts) {
  Problem problem = load_problem("planar/two_arms");
  const auto made = [&](const char* measure) {
    resolve(problem, {problem.name, measure}).make_measure();
  };
  EXPECT_NO_THROW(made("ellipsoid"));
  problem.contact->w_max[0] = 5;
  EXPECT_THROW(made("ellipsoid"), std::invalid_argument);
  EXPECT_THROW(made("least_effort"), std::invalid_argument);
  EXPECT_NO_THROW(made("linf_polytope"));
  EXPECT_NO_THROW(made("manipulability"));
}

TEST(Method, ProductHoldsEachMeaningfulCombinationOnce) {
  const Problem problem = load_problem("planar/force");
  const std::vector<Case> cases = product(problem, 3, 100);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(resolve(problem, cases[i]).choice.solver, cases[i].solver);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(case_values(cases[i]), case_values(cases[j]));
  }
}

TEST(Method, ProductCrossesEverySearchAndEverySolverWithoutCrossingBoth) {
  const std::vector<Case> cases = product(load_problem("planar/force"), 1, 100);
  for (const SearchEntry& search : searches())
    EXPECT_FALSE(select(cases, {{"search", search.name}, {"solver", "facets"}}).empty());
  for (const WrenchSolverEntry& solver : wrench_solvers())
    EXPECT_FALSE(select(cases, {{"search", general_search()}, {"solver", solver.name}}).empty());
  EXPECT_THROW(select(cases, {{"search", "multistart"}, {"solver", "ipopt"}}),
               std::invalid_argument);
}

/// As trajectories of one knot, by the solver of the same name if there is one.
TEST(Method, SearchesOfTrajectoriesSupportStaticTasksByLinfPolytope) {
  const Problem problem = load_problem("planar/force");
  const auto solver = [&](const char* measure, Wrench wrench, const char* lp, const char* search) {
    const TrajectorySolverEntry* entry =
        resolve(problem, {problem.name, measure, wrench, lp, search}).trajectory_solver;
    return std::string(entry ? entry->name : "");
  };
  EXPECT_EQ(solver("linf_polytope", Wrench::kPure, "", "slp"), "facets_or_ipm");  // facets
  EXPECT_EQ(solver("linf_polytope", Wrench::kAny, "", "slp"), "facets_or_ipm");   // box
  EXPECT_EQ(solver("linf_polytope", Wrench::kPure, "simplex", "slp"), "simplex");
  EXPECT_EQ(solver("linf_polytope", Wrench::kPure, "", "grid"), "");
  EXPECT_EQ(solver("l2_polytope", Wrench::kPure, "", "slp"), "");
  EXPECT_TRUE(supported_as_trajectory(problem, "linf_polytope"));
  EXPECT_FALSE(supported_as_trajectory(problem, "ellipsoid"));
  EXPECT_TRUE(supported_as_trajectory(load_problem("mobile/push"), "linf_polytope"));
  EXPECT_FALSE(supported_as_trajectory(load_problem("planar/two_arms"), "linf_polytope"));
  const std::vector<Case> cases = product(problem, 1, 100);
  for (const SearchEntry& search : trajectory_searches()) {
    for (const Case& c : select(cases, {{"search", search.name}})) {
      EXPECT_EQ(c.measure, "linf_polytope");
    }
    EXPECT_EQ(select(cases, {{"search", search.name}}).size(), 2U);  // pure and any
  }
  EXPECT_THROW(select(product(load_problem("planar/two_arms"), 1, 100), {{"search", "slp"}}),
               std::invalid_argument);
}

TEST(Method, SearchesBetweenFacetsSupportLinfPolytopeWithFewFacets) {
  for (const char* name : {"planar/force", "planar/two_arms", "mobile/push"}) {
    const Problem problem = load_problem(name);
    EXPECT_TRUE(supported_between_facets(problem, "linf_polytope", Wrench::kPure)) << name;
    EXPECT_FALSE(supported_between_facets(problem, "l2_polytope", Wrench::kPure)) << name;
    const std::vector<Case> cases = product(problem, 1, 100);
    for (const SearchEntry& search : facet_searches()) {
      const std::vector<Case> its = select(cases, {{"search", search.name}});
      EXPECT_EQ(its.size(), 2U) << name;  // pure and any
      for (const Case& c : its) EXPECT_EQ(c.measure, "linf_polytope");
    }
  }
  Problem many = load_problem("planar/force");
  many.robot.actuation.has_facets = false;
  EXPECT_FALSE(supported_between_facets(many, "linf_polytope", Wrench::kPure));
  EXPECT_FALSE(
      supported_between_facets(load_problem("planar/trajectory"), "linf_polytope", Wrench::kPure));
}

TEST(Method, SelectKeepsWhatMatches) {
  const std::vector<Case> cases = product(load_problem("planar/force"), 1, 100);
  for (const Case& c : select(cases, {{"measure", "ellipsoid"}, {"wrench", "any"}})) {
    EXPECT_EQ(c.measure, "ellipsoid");
    EXPECT_EQ(c.wrench, Wrench::kAny);
  }
  EXPECT_EQ(select(cases, {{"seed", "5"}}).size(), cases.size());
  EXPECT_EQ(select(cases, {{"scheme", "none"}, {"integrator", "none"}}).size(), cases.size());
  EXPECT_THROW(select(cases, {{"colour", "red"}}), std::invalid_argument);
  EXPECT_THROW(select(cases, {{"measure", "ellipsoid"}, {"solver", "facets"}}),
               std::invalid_argument);
}

TEST(Method, SchemesAreThoseOfTheTask) {
  Problem turn = load_problem("planar/trajectory");
  set_scheme("scheme", "ends", turn);
  EXPECT_EQ(turn.motion->scheme, Scheme::kEnds);
  EXPECT_THROW(set_scheme("scheme", "backward", turn), std::invalid_argument);
  turn.motion->k = 1;
  EXPECT_THROW(set_scheme("scheme", "spline", turn), std::invalid_argument);
  for (const Case& c : product(turn, 1, 100)) EXPECT_NE(c.scheme, "spline");
  const Problem still = load_problem("planar/force");
  EXPECT_THROW(resolve(still, {.problem = still.name, .scheme = "ends"}), std::invalid_argument);
}

/// Each row of the product of a task in time is another case, which its problem resolves to itself.
TEST(Method, ProductOfATaskInTimeCrossesItsSchemes) {
  Problem impulse = load_problem("uvms/valve_impulse");
  const std::vector<Case> cases = product(impulse, 3, 100);
  std::set<std::vector<std::string>> different;
  for (const Case& c : cases) {
    set_scheme("scheme", c.scheme, impulse);
    EXPECT_EQ(case_values(resolve(impulse, c).choice), case_values(c));
    different.insert(case_values(c));
  }
  EXPECT_EQ(different.size(), cases.size());
  for (const std::string& scheme : scheme_names(true)) {
    for (const SearchEntry& search : searches())
      EXPECT_FALSE(select(cases, {{"search", search.name}, {"scheme", scheme}}).empty());
    for (const TrajectorySolverEntry& solver : trajectory_solvers())
      EXPECT_FALSE(select(cases, {{"solver", solver.name}, {"scheme", scheme}}).empty());
  }
  EXPECT_THROW(select(cases, {{"scheme", "ends"}}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
