#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "tests/support/objectives.h"

namespace maxwrench {
namespace {

TEST(TrajectoryInterruption, EndsASearchSoonWithWhatItHas) {
  const Problem problem = load_problem("planar/trajectory");
  for (const char* name : {"slp", "dp", "joint_nlp", "gradient_projection", "mpc", "multistart"}) {
    for (const long evaluations : {0, 1, 2, 5, 19, 20, 21, 25, 40, 80, 150}) {
      const bool throughout = name == std::string("slp") && evaluations % 2 == 1;
      const auto objective = make_trajectory_objective(
          problem, Wrench::kPure, find_trajectory_solver("facets_or_ipm").make, true,
          throughout ? TrajectoryValue::kThroughout : TrajectoryValue::kAtInstants);
      SearchOptions options;
      const Interruption interruption(evaluations, options);
      options.budget = 200;
      options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
      const SearchResult result = find_search(name).make()->maximize(*objective, options);
      EXPECT_EQ(result.status, evaluations == 0 ? Status::kNoneFound : Status::kBestFound)
          << name << ' ' << evaluations;
      EXPECT_TRUE(result.interrupted || result.evaluations < evaluations);
      // None is made any more, but the two that say what the best trajectory so far is worth
      // throughout.
      EXPECT_GE(interruption.left(), throughout ? -2 : 0) << name << ' ' << evaluations;
      EXPECT_EQ(result.evaluations, evaluations - interruption.left());
      ASSERT_EQ(result.history.empty(), evaluations == 0);
      if (evaluations > 0) {
        EXPECT_EQ(result.history.back().value, result.value);
      }
    }
  }
}

TEST(TrajectoryInterruption, NothingIsLinearisedBeforeAnEvaluation) {
  const Problem problem = load_problem("planar/trajectory");
  TrajectoryEvaluator trajectories(problem, Wrench::kPure,
                                   find_trajectory_solver("facets_or_ipm").make);
  EXPECT_THROW(trajectories.linearize(), std::logic_error);
}

}  // namespace
}  // namespace maxwrench
