#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

/// The paper's bilevel method on trajectories: above the start, within the rows of the knots, and
/// no more evaluations than allowed.
TEST(Multistart, SLOW_LocalSearchesTrajectoriesWithinTheirRows) {
  for (const char* name : {"planar/trajectory", "uvms/valve_impulse"}) {
    const Problem problem = load_problem(name);
    const auto objective = make_trajectory_objective(problem, Wrench::kPure,
                                                     find_trajectory_solver("facets_or_ipm").make);
    SearchOptions options;
    options.budget = 200;
    options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
    const double start = objective->evaluate(options.start);
    const SearchResult result = find_search("multistart").make()->maximize(*objective, options);
    ASSERT_EQ(result.status, Status::kBestFound) << name;
    EXPECT_LE(result.evaluations, options.budget);
    EXPECT_GT(result.value, start + 0.01 * std::abs(start)) << name;
    const KnotRows& rows = *objective->rows();
    const Eigen::VectorXd at = rows.R * result.theta_r;
    EXPECT_LE((at - rows.r_max).maxCoeff(), 1e-6) << name;
    EXPECT_LE((rows.r_min - at).maxCoeff(), 1e-6) << name;
  }
}

}  // namespace
}  // namespace maxwrench
