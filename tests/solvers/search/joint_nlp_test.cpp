#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

SearchResult search(const Problem& problem, const SearchOptions& options) {
  const auto objective = make_trajectory_objective(problem, Wrench::kPure,
                                                   find_trajectory_solver("facets_or_ipm").make);
  return find_search("joint_nlp").make()->maximize(*objective, options);
}

SearchOptions options_of(const Problem& problem, long budget) {
  SearchOptions options;
  options.budget = budget;
  options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
  return options;
}

TEST(JointNlp, SLOW_FindsWhatTheLowerLevelConfirms) {
  const Problem problem = load_problem("planar/trajectory");
  const SearchResult result = search(problem, options_of(problem, 2000));
  ASSERT_EQ(result.status, Status::kBestFound);
  EXPECT_LE(result.evaluations, 2000);
  TrajectoryEvaluator trajectories(problem, Wrench::kPure, find_trajectory_solver("simplex").make);
  const Trajectory& trajectory =
      trajectories.evaluate(unstacked(result.theta_r, knots_of(problem)));
  ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
  EXPECT_NEAR(trajectory.value, result.value, 1e-7 * (1 + result.value));
  // No worse by 1 % than what linear programs find.
  const auto objective = make_trajectory_objective(problem, Wrench::kPure,
                                                   find_trajectory_solver("facets_or_ipm").make);
  const SearchResult slp =
      find_search("slp").make()->maximize(*objective, options_of(problem, 2000));
  EXPECT_GE(result.value, 0.99 * slp.value);
}

TEST(JointNlp, SpendsNoMoreThanItsBudget) {
  const Problem problem = load_problem("planar/trajectory");
  for (const long budget : {1, 10, 60}) {
    const SearchResult result = search(problem, options_of(problem, budget));
    EXPECT_LE(result.evaluations, budget);
    EXPECT_EQ(result.status, Status::kBestFound);
  }
}

TEST(JointNlp, RejectsObjectivesWithoutTrajectories) {
  const Problem problem = load_problem("planar/force");
  const auto objective = make_capability_objective(problem, Wrench::kPure, [&] {
    return find_measure("linf_polytope").make(problem, find_wrench_solver("facets").make());
  });
  EXPECT_THROW(find_search("joint_nlp").make()->maximize(*objective, {}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
