#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/plan.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "tests/support/objectives.h"

namespace maxwrench {
namespace {

TEST(PlanInterruption, EndsASearchSoonWithWhatItHas) {
  const Problem problem = load_problem("planar/trajectory");
  for (const char* name : {"slp", "joint_nlp", "multistart"}) {
    for (const long evaluations : {0, 1, 2, 5, 19, 20, 21, 25, 40, 80, 150}) {
      const auto left = std::make_shared<long>(evaluations);
      Ending objective(
          make_plan_objective(problem, Wrench::kPure, find_plan_solver("structured").make), left);
      SearchOptions options;
      options.budget = 200;
      options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
      const SearchResult result = find_search(name).make()->maximize(objective, options);
      EXPECT_EQ(result.status, evaluations == 0 ? Status::kNoneFound : Status::kBestFound)
          << name << ' ' << evaluations;
      EXPECT_LE(result.evaluations, options.budget);
      EXPECT_GT(*left, -100) << name << ' ' << evaluations;
    }
  }
}

TEST(PlanInterruption, NothingIsLinearisedBeforeAnEvaluation) {
  const Problem problem = load_problem("planar/trajectory");
  PlanEvaluator plans(problem, Wrench::kPure, find_plan_solver("structured").make);
  EXPECT_THROW(plans.linearize(), std::logic_error);
}

}  // namespace
}  // namespace maxwrench
