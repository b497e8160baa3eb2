#include <gtest/gtest.h>

#include <algorithm>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/search/knot_starts.h"
#include "tests/support/drawn_starts.h"
#include "tests/support/objectives.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

/// A table whose knots are alike stands for the same motion with any number of knots. So the values
/// at the instants differ only by which instants count, and those of the coarser objective are
/// among the instants between the knots of the task: k = 10 has 37 instants, k = 4 has 7, every
/// sixth.
TEST(CoarserObjective, HasTheValueOfTheSameMotionAtFewerInstants) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const auto objective = trajectories_to_draw(problem);
  const auto coarse = objective->coarser();
  ASSERT_NE(coarse, nullptr);
  EXPECT_EQ(coarse->dimension(), 4 * problem.redundancy());
  EXPECT_EQ(coarse->counts(), TrajectoryValue::kAtInstants);
  const VectorXd alike = problem.theta_r_default;
  const double all = objective->evaluate(alike.replicate(problem.motion->k, 1));
  const double few = coarse->evaluate(alike.replicate(4, 1));
  EXPECT_GE(few, all - 1e-9);
  // The instants of the coarser one, evaluated in the motion of the task.
  objective->trajectories().evaluate(constant_knots(problem, alike));
  const std::vector<Instant>& instants = objective->trajectories().trajectory().instants;
  ASSERT_EQ(instants.size(), 37U);
  coarse->trajectories().evaluate(unstacked(alike.replicate(4, 1), 4));
  const std::vector<Instant>& coarser = coarse->trajectories().trajectory().instants;
  ASSERT_EQ(coarser.size(), 7U);
  for (std::size_t i = 0; i < coarser.size(); ++i) {
    EXPECT_NEAR(coarser[i].t, instants[6 * i].t, 1e-12);
    EXPECT_LT((coarser[i].tau_d - instants[6 * i].tau_d).norm(), 1e-9);
  }
  // It outlives the objective that it was made of, and its clones outlive it.
  const auto clone = coarse->clone();
  EXPECT_EQ(clone->evaluate(alike.replicate(4, 1)), few);
}

TEST(CoarserObjective, ThereIsNoneOfImpulsesTransfersFewKnotsAndOtherSchemes) {
  const Problem impulse = load_problem("uvms/valve_impulse");
  EXPECT_EQ(trajectories_to_draw(impulse)->coarser(), nullptr);
  Problem problem = load_problem("planar/trajectory");
  ASSERT_NE(trajectories_to_draw(problem)->coarser(), nullptr);
  problem.motion->scheme = Scheme::kForward;
  EXPECT_EQ(trajectories_to_draw(problem)->coarser(), nullptr);
  problem.motion->scheme = Scheme::kSpline;
  problem.motion->k = 4;
  EXPECT_EQ(trajectories_to_draw(problem)->coarser(), nullptr);
  const Problem fixed = load_problem("planar/force");
  EXPECT_EQ(trajectories_to_draw(fixed)->coarser(), nullptr);
}

class CoarseStartsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tasks, CoarseStartsOf,
                         testing::Values("planar/trajectory", "mobile/trajectory",
                                         "uvms/valve_trajectory"));

TEST_P(CoarseStartsOf, AreTablesOfTheTaskWithAValueWithinAllLimits) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const SearchOptions options = draw_options(problem, 2000);
  const Drawn coarse(find_coarse_starts, *objective, options);
  ASSERT_GT(coarse.starts.size(), 1U);
  EXPECT_EQ(coarse.starts.back().theta_r, options.start);
  const KnotRows& rows = objective->trajectories().rows();
  double best = -kInfinity;
  for (const Candidate& start : coarse.starts) {
    EXPECT_NEAR(objective->evaluate(start.theta_r), start.value, 1e-9);
    EXPECT_TRUE((start.theta_r.array() >= objective->lower().array()).all());
    EXPECT_TRUE((start.theta_r.array() <= objective->upper().array()).all());
    const VectorXd at = rows.R * start.theta_r;
    EXPECT_LE((at - rows.r_max).maxCoeff(), 1e-9);
    EXPECT_LE((rows.r_min - at).maxCoeff(), 1e-9);
    best = std::max(best, start.value);
  }
  // Only tables of the task are reported as values, among them tables that are not returned.
  EXPECT_EQ(coarse.found.best.value, best);
  EXPECT_EQ(coarse.shown, coarse.found.trace.evaluations());
  // A tenth and two fifths of the budget, and the tables of the task.
  EXPECT_LE(coarse.found.trace.evaluations(), 200 + 800 + 2 * 24 + 1);
}

TEST_P(CoarseStartsOf, AreTheSameAtAnyThreadCount) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const Drawn one(find_coarse_starts, *objective, draw_options(problem, 500, 1));
  const Drawn four(find_coarse_starts, *objective, draw_options(problem, 500, 4));
  expect_same(one, four);
}

TEST(CoarseStarts, NoneForSmallBudgetsAndOnceTheRunHasEnded) {
  const Problem problem = load_problem("planar/trajectory");
  const auto objective = trajectories_to_draw(problem);
  const Drawn small(find_coarse_starts, *objective, draw_options(problem, 100));
  EXPECT_TRUE(small.starts.empty());
  EXPECT_EQ(small.found.trace.evaluations(), 0);
  SearchOptions options = draw_options(problem, 2000);
  options.interrupted = [] { return true; };
  const Drawn ended(find_coarse_starts, *objective, options);
  EXPECT_TRUE(ended.starts.empty());
  EXPECT_EQ(ended.found.trace.evaluations(), 0);
}

/// A user's objective that has no coarser one.
TEST(CoarseStarts, NoneWithoutACoarserObjective) {
  const Problem problem = load_problem("planar/trajectory");
  auto objective = trajectories_to_draw(problem);
  const VectorXd lower = objective->lower(), upper = objective->upper();
  OtherBounds bounded(std::move(objective), lower, upper);
  EXPECT_TRUE(Drawn(find_coarse_starts, bounded, draw_options(problem, 2000)).starts.empty());
}

/// The turn of the valve has optima of many families, of which the best is 35.8234 N m at the
/// instants (`docs/algorithms`): each of 20 seeds comes within 0.1 %.
TEST(CoarseStarts, SLOW_TheTurnReachesItsBestWithEverySeed) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const auto objective = trajectories_to_draw(problem);
  double best = -kInfinity, worst = kInfinity;
  for (int seed = 1; seed <= 20; ++seed) {
    SearchOptions options = draw_options(problem, 20'000);
    options.seed = static_cast<std::uint64_t>(seed);
    const double value = find_search("slp").make()->maximize(*objective, options).value;
    best = std::max(best, value);
    worst = std::min(worst, value);
  }
  EXPECT_GE(worst, best * (1 - 1e-3));
}

}  // namespace
}  // namespace maxwrench
