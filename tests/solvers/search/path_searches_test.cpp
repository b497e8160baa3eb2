#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/method.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

std::unique_ptr<TrajectoryObjective> path_objective(const Problem& problem) {
  return make_trajectory_objective(problem, Wrench::kPure,
                                   find_trajectory_solver("facets_or_ipm").make);
}

SearchOptions path_options(const Problem& problem, long budget) {
  SearchOptions options;
  options.budget = budget;
  options.start = stacked(default_knots(problem));
  return options;
}

class PathSearch : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, PathSearch, testing::Values("gradient_projection", "mpc"),
                         [](const auto& named) { return named.param; });

/// The value is that of the plan by the task's own evaluation, never below that of the start, and
/// the budget is never exceeded.
TEST_P(PathSearch, ReportsThePlansOwnValue) {
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory", "mobile/trajectory"}) {
    const Problem problem = load_problem(name);
    for (const long budget : {1L, 2L, 3L, 17L, 120L}) {
      const auto objective = path_objective(problem);
      const SearchOptions options = path_options(problem, budget);
      const SearchResult result = find_search(GetParam()).make()->maximize(*objective, options);
      EXPECT_LE(result.evaluations, budget) << name;
      EXPECT_GE(result.value, objective->evaluate(options.start)) << name;
      EXPECT_EQ(result.value, objective->evaluate(result.theta_r)) << name;
      EXPECT_FALSE(result.stopped.empty());
    }
  }
}

/// Both need no drawn numbers but those of the seed.
TEST_P(PathSearch, IsTheSameAgain) {
  const Problem problem = load_problem("planar/trajectory");
  const auto objective = path_objective(problem);
  SearchOptions options = path_options(problem, 150);
  const SearchResult one = find_search(GetParam()).make()->maximize(*objective, options);
  options.threads = 3;
  const SearchResult two = find_search(GetParam()).make()->maximize(*objective, options);
  EXPECT_EQ(one.theta_r, two.theta_r);
  EXPECT_EQ(one.value, two.value);
  EXPECT_EQ(one.evaluations, two.evaluations);
  EXPECT_EQ(one.stopped, two.stopped);
}

TEST_P(PathSearch, RefusesWhatIsNoPath) {
  Problem one_knot = load_problem("planar/trajectory");
  one_knot.motion->k = 1;
  one_knot.motion->scheme = Scheme::kForward;
  for (const Problem& problem :
       {load_problem("planar/force"), load_problem("uvms/valve_impulse"), one_knot,
        load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/luus.toml")}) {
    const auto objective = path_objective(problem);
    for (const long budget : {1L, 50L}) {
      EXPECT_THROW(
          find_search(GetParam()).make()->maximize(*objective, path_options(problem, budget)),
          std::invalid_argument)
          << problem.name;
    }
    const auto names = supported_searches(problem, "linf_polytope", Wrench::kPure);
    EXPECT_EQ(std::count(names.begin(), names.end(), GetParam()), 0) << problem.name;
  }
  const auto names =
      supported_searches(load_problem("planar/trajectory"), "linf_polytope", Wrench::kPure);
  EXPECT_EQ(std::count(names.begin(), names.end(), GetParam()), 1);
}

/// So heavy that no thrust holds it.
TEST_P(PathSearch, FindsNothingWhereNothingBalances) {
  Problem problem = load_problem("uvms/valve_trajectory");
  add_body(problem.robot.links[0], 1000, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
  const Case c{problem.name, "linf_polytope", Wrench::kPure, "", GetParam(), 1, 60};
  const Answer answer = solve(problem, {c, 1});
  EXPECT_EQ(answer.status, Status::kNoneFound);
  EXPECT_FALSE(answer.has_value());
  EXPECT_LE(answer.evaluations, 60);
}

/// The search finds more than the start, and says what its own evaluation says.
void expect_better_than_the_start(const std::string& search, const Problem& problem) {
  const auto objective = path_objective(problem);
  const SearchOptions options = path_options(problem, 600);
  const SearchResult result = find_search(search).make()->maximize(*objective, options);
  EXPECT_EQ(result.status, Status::kBestFound) << problem.name;
  EXPECT_GT(result.value, objective->evaluate(options.start)) << problem.name;
  EXPECT_EQ(result.value, objective->evaluate(result.theta_r)) << problem.name;
}

TEST_P(PathSearch, SupportsOtherSchemes) {
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    Problem problem = load_problem("planar/trajectory");
    problem.motion->scheme = scheme;
    expect_better_than_the_start(GetParam(), problem);
  }
}

TEST_P(PathSearch, SLOW_SupportsPayloadsAndLists) {
  const std::string folder = MAXWRENCH_SOURCE_DIR "/examples/tasks/";
  for (const char* name : {"carry_steel_along.toml", "turn_along_with_a_dead_thruster.toml"}) {
    expect_better_than_the_start(GetParam(), load_problem(folder + name));
  }
}

}  // namespace
}  // namespace maxwrench
