#include <gtest/gtest.h>

#include <string>

#include "lib/search/facet_program.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/method.h"
#include "tests/support/objectives.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

std::unique_ptr<Objective> objective_of(const Problem& problem, Wrench wrench = Wrench::kPure) {
  Case c{problem.name};
  c.wrench = wrench;
  return make_capability_objective(problem, wrench, resolve(problem, c).make_measure);
}

class FacetSearch : public testing::TestWithParam<SearchEntry> {
 protected:
  SearchResult maximize(Objective& objective, const SearchOptions& options) {
    return GetParam().make()->maximize(objective, options);
  }
  static SearchOptions options_of(long budget, std::uint64_t seed = 1) {
    SearchOptions options;
    options.budget = budget;
    options.seed = seed;
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(All, FacetSearch,
                         testing::ValuesIn(facet_searches().begin(), facet_searches().end()),
                         [](const auto& each) { return std::string(each.param.name); });

/// The optima that the paper's numbers [N] and all other searches agree on. Without choosing starts
/// by a sample, and with no refinement.
TEST_P(FacetSearch, SLOW_ReachesTheBestKnownOfPlanarForce) {
  const Problem problem = load_problem("planar/force");
  const auto pure = objective_of(problem), any = objective_of(problem, Wrench::kAny);
  const SearchResult found = maximize(*pure, options_of(2000));
  EXPECT_NEAR(found.value, 3.47748, 1e-5);
  EXPECT_EQ(found.value, pure->evaluate(found.theta_r));
  const SearchResult crs = find_search("crs2").make()->maximize(*any, options_of(20000));
  EXPECT_NEAR(maximize(*any, options_of(5000)).value, crs.value, 1e-5);
}

/// The best posture of the valve touches itself: random ones are all worse by a thousandth.
TEST_P(FacetSearch, SLOW_ReachesTheBestKnownOfTheValve) {
  const Problem problem = load_problem("uvms/valve");
  const auto objective = objective_of(problem);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_GE(maximize(*objective, options_of(10000, seed)).value, 0.999 * 35.40802) << seed;
  }
}

/// The second contact's wrenches and the limits of its arm are in the program.
TEST_P(FacetSearch, SLOW_ReachesTheBestKnownWithASecondContact) {
  const Problem problem = load_problem("dual_arm/bar_wall");
  const auto objective = objective_of(problem);
  EXPECT_GE(maximize(*objective, options_of(3000)).value, 0.999 * 37.94392);
}

TEST_P(FacetSearch, RejectsWhatHasNoFacets) {
  Problem many = load_problem("planar/force");
  many.robot.actuation.has_facets = false;
  const Problem few = load_problem("planar/force"), motion = load_problem("planar/trajectory");
  Case l2{few.name};
  l2.measure = "l2_polytope";
  const auto of_l2 = make_capability_objective(few, Wrench::kPure, resolve(few, l2).make_measure);
  const auto of_many = objective_of(many);
  const std::unique_ptr<Objective> of_trajectories =
      make_trajectory_objective(motion, Wrench::kPure, trajectory_solvers().front().make);
  for (Objective* objective : {of_l2.get(), of_many.get(), of_trajectories.get()}) {
    try {
      maximize(*objective, {});
      ADD_FAILURE() << "not rejected";
    } catch (const std::invalid_argument& error) {
      const std::string line = error.what();
      EXPECT_NE(line.find(GetParam().name), std::string::npos) << line;
      EXPECT_NE(line.find("expected another search"), std::string::npos) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

/// uvms/valve with a thousand kilograms: each start has a posture that no efforts hold.
TEST_P(FacetSearch, SaysWhenNothingHasAValue) {
  Problem problem = load_problem("uvms/valve");
  add_body(problem.robot.links[0], 1000, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
  const auto objective = objective_of(problem);
  const SearchResult result = maximize(*objective, options_of(300));
  EXPECT_EQ(result.status, Status::kNoneFound);
  EXPECT_LE(result.evaluations, 300);
}

/// The start of bar_wall is replaced by one that reaches nothing: it is counted and passed over.
TEST_P(FacetSearch, PassesStartsWithoutAPosture) {
  const Problem problem = load_problem("dual_arm/bar_wall");
  const auto objective = objective_of(problem);
  SearchOptions options = options_of(400);
  options.start = problem.theta_r_max;
  const SearchResult result = maximize(*objective, options);
  EXPECT_EQ(result.status, Status::kBestFound);
  EXPECT_LE(result.evaluations, 400);
}

TEST_P(FacetSearch, SLOW_KeepsTheBudgetAndReportsIt) {
  for (const char* name : {"planar/force", "dual_arm/two_arms"}) {
    const Problem problem = load_problem(name);
    const auto objective = objective_of(problem);
    for (const long budget : {1, 2, 3, 4, 7, 50, 1000}) {
      SearchOptions options = options_of(budget);
      options.start = problem.theta_r_default;
      std::atomic<long> reported = 0;
      options.progress = [&](long evaluations) {
        reported = std::max(reported.load(), evaluations);
      };
      const SearchResult result = maximize(*objective, options);
      EXPECT_LE(result.evaluations, budget);
      EXPECT_GE(result.evaluations, 1);
      EXPECT_EQ(result.status, Status::kBestFound) << name << budget;  // the default has a value
      EXPECT_EQ(reported, result.evaluations);
    }
  }
}

TEST_P(FacetSearch, SLOW_ThreadsChangeNothing) {
  for (const char* name : {"planar/force", "dual_arm/two_arms"}) {
    const Problem problem = load_problem(name);
    const auto objective = objective_of(problem, Wrench::kAny);
    SearchOptions options = options_of(2500);
    const SearchResult one = maximize(*objective, options);
    for (const int threads : {2, 8}) {
      options.threads = threads;
      const SearchResult many = maximize(*objective, options);
      EXPECT_EQ(one.value, many.value);
      EXPECT_EQ(one.theta_r, many.theta_r);
      EXPECT_EQ(one.evaluations, many.evaluations);
    }
  }
}

/// Interrupted, it ends soon and keeps what it has found.
TEST_P(FacetSearch, EndsWhenItIsInterrupted) {
  const Problem problem = load_problem("planar/force");
  const auto objective = objective_of(problem);
  SearchOptions options = options_of(2000);
  const Interruption interruption(3, options);
  const SearchResult result = maximize(*objective, options);
  EXPECT_EQ(result.status, Status::kBestFound);
  EXPECT_TRUE(result.interrupted);
  EXPECT_LE(result.evaluations, 4);
}

/// Nothing to choose: there is one posture.
TEST_P(FacetSearch, EvaluatesTheOnlyPosture) {
  Problem problem = load_problem("planar/force");
  problem.theta_r_min = problem.theta_r_max = problem.theta_r_default;
  const auto objective = objective_of(problem);
  const SearchResult result = maximize(*objective, options_of(100));
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.value, objective->evaluate(problem.theta_r_default));
}

}  // namespace
}  // namespace maxwrench
