#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

std::unique_ptr<TrajectoryObjective> objective_of(const Problem& problem, TrajectoryValue counts) {
  return make_trajectory_objective(problem, Wrench::kPure,
                                   find_trajectory_solver("facets_or_ipm").make, true, counts);
}

/// For what is possible throughout.
SearchResult search(const Problem& problem, long budget, int threads = 2, std::uint64_t seed = 1) {
  const auto objective = objective_of(problem, TrajectoryValue::kThroughout);
  SearchOptions options;
  options.budget = budget;
  options.seed = seed;
  options.threads = threads;
  options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
  return find_search("slp").make()->maximize(*objective, options);
}

Trajectory trajectory_of(const Problem& problem, const SearchResult& result) {
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, find_trajectory_solver("ipm").make);
  evaluator.evaluate(unstacked(result.theta_r, knots_of(problem)));
  evaluator.evaluate_between_knots();
  return evaluator.trajectory();
}

/// What an independent model found by other methods, less a margin (N m).
struct Wanted {
  const char* problem;
  Scheme scheme;
  double value;
  std::uint64_t seeds;
};

class SlpFinds : public testing::TestWithParam<Wanted> {};
INSTANTIATE_TEST_SUITE_P(Tasks, SlpFinds,
                         testing::Values(Wanted{"uvms/valve_trajectory", Scheme::kSpline, 35.73, 2},
                                         Wanted{"uvms/valve_trajectory", Scheme::kEnds, 35.407, 2},
                                         Wanted{"uvms/valve_impulse", Scheme::kSpline, 39.87, 1}));

TEST_P(SlpFinds, SLOW_TrajectoriesThatHoldBetweenTheirInstants) {
  Problem problem = load_problem(GetParam().problem);
  problem.motion->scheme = GetParam().scheme;
  for (std::uint64_t seed = 1; seed <= GetParam().seeds; ++seed) {
    const SearchResult result = search(problem, 20000, 2, seed);
    ASSERT_EQ(result.status, Status::kBestFound);
    const Trajectory trajectory = trajectory_of(problem, result);
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    const bool smooth = GetParam().scheme == Scheme::kSpline;
    EXPECT_NEAR(
        smooth ? std::min(trajectory.value, trajectory.value_between_knots) : trajectory.value,
        result.value, 1e-7);
    EXPECT_GE(trajectory.value, GetParam().value) << seed;
    if (!smooth) continue;
    EXPECT_LE(std::abs(trajectory.value - trajectory.value_between_knots), 0.005 * trajectory.value)
        << seed;
  }
}

TEST(Slp, SameAtAnyThreadCount) {
  const Problem problem = load_problem("planar/trajectory");
  const SearchResult one = search(problem, 200, 1), four = search(problem, 200, 4);
  ASSERT_EQ(one.status, Status::kBestFound);
  EXPECT_EQ(one.theta_r, four.theta_r);
  EXPECT_EQ(one.evaluations, four.evaluations);
  EXPECT_LE(one.evaluations, 200);
  ASSERT_FALSE(one.history.empty());
  EXPECT_EQ(one.history.back().value, one.value);
}

/// Whatever its objective counts: the best value that it has evaluated is the last of its history,
/// and that of its point. Before, trajectories of higher value were seen and then left out.
TEST(Slp, SLOW_ReturnsTheBestOfItsObjective) {
  for (const char* name : {"planar/trajectory", "mobile/trajectory"}) {
    const Problem problem = load_problem(name);
    for (const TrajectoryValue counts :
         {TrajectoryValue::kAtInstants, TrajectoryValue::kThroughout}) {
      const auto objective = objective_of(problem, counts);
      SearchOptions options;
      options.budget = 400;
      options.start = problem.theta_r_default.replicate(problem.motion->k, 1);
      long shown = 0;
      double best = -kInfinity;
      options.evaluated = [&](double value) {
        ++shown;
        best = std::max(best, value);
      };
      const SearchResult result = find_search("slp").make()->maximize(*objective, options);
      ASSERT_EQ(result.status, Status::kBestFound);
      EXPECT_EQ(result.value, best);
      EXPECT_EQ(result.evaluations, shown);
      EXPECT_EQ(result.history.back().value, result.value);
      EXPECT_NEAR(objective->evaluate(result.theta_r), result.value, 1e-9);
      long programs = 0;
      for (const Call& call : result.calls) programs += call.evaluations;
      EXPECT_GT(programs, 50);
      EXPECT_LT(programs, result.evaluations / 2);
    }
  }
}

/// What is possible throughout costs three programs, of the sample's and the judgement's; fewer
/// evaluations find nothing.
TEST(Slp, NeedsThreeEvaluations) {
  const Problem problem = load_problem("planar/trajectory");
  for (const long budget : {1, 2, 3, 4}) {
    const SearchResult result = search(problem, budget);
    EXPECT_EQ(result.status, budget < 3 ? Status::kNoneFound : Status::kBestFound) << budget;
    EXPECT_EQ(result.evaluations, budget < 3 ? 1 : 3) << budget;
  }
}

TEST(Slp, RisesFromTheStart) {
  const Problem problem = load_problem("planar/trajectory");
  const SearchResult result = search(problem, 300);
  const auto objective = make_trajectory_objective(problem, Wrench::kPure,
                                                   find_trajectory_solver("facets_or_ipm").make);
  const double start = objective->evaluate(problem.theta_r_default.replicate(problem.motion->k, 1));
  EXPECT_GT(result.value, 1.5 * start);
}

/// In 2 s the elbow of the wheeled base wants to turn faster than it may in the second search,
/// which sees that limit as a row, though the elbow follows from theta_r.
TEST(Slp, SLOW_KeepsTheSpeedLimitOfADependentJoint) {
  Problem problem = load_problem("mobile/trajectory");
  MotionTask& task = *problem.motion;
  task.T = 2;
  task.path = Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), {0, 0.9, 0.9}, M_PI / 3,
                          Eigen::Vector3d::Zero(), Timing::kCubic, task.T);
  const int elbow = problem.dependent.front(), axes = 3;
  const auto fastest = [&](const Trajectory& trajectory) {
    double rate = 0;
    for (const Instant& at : trajectory.instants)
      rate = std::max(rate, std::abs(at.v[axes + elbow]));
    return rate;
  };
  const long budget = 2000;
  const Trajectory free = trajectory_of(problem, search(problem, budget));
  ASSERT_EQ(free.status, Status::kOptimal) << free.reason.c_str();
  const double limit = fastest(free) / 2;
  problem.robot.joints[static_cast<std::size_t>(elbow)].velocity_max = limit;
  const Trajectory bound = trajectory_of(problem, search(problem, budget));
  ASSERT_EQ(bound.status, Status::kOptimal) << bound.reason.c_str();
  EXPECT_LE(fastest(bound), limit + 1e-6);
  EXPECT_LT(bound.value, free.value);
  EXPECT_GE(fastest(bound), 0.9 * limit);
  EXPECT_GT(bound.value, 0.9 * free.value);
}

/// A static problem is a trajectory of one knot: the independent model's best posture has 35.4077 N
/// m.
TEST(Slp, SupportsAStaticProblemAsATrajectoryOfOneKnot) {
  const Problem problem = load_problem("uvms/valve");
  const auto objective = make_trajectory_objective(problem, Wrench::kPure,
                                                   find_trajectory_solver("facets_or_ipm").make);
  SearchOptions options;
  options.budget = 5000;
  options.start = problem.theta_r_default;
  const SearchResult result = find_search("slp").make()->maximize(*objective, options);
  ASSERT_EQ(result.status, Status::kBestFound);
  EXPECT_EQ(result.theta_r.size(), problem.redundancy());
  EXPECT_GE(result.value, 35.407);
  EXPECT_LE(result.value, 35.41);
}

TEST(Slp, RejectsObjectivesWithoutTrajectories) {
  const Problem problem = load_problem("planar/force");
  const auto objective = make_capability_objective(problem, Wrench::kPure, [&] {
    return find_measure("linf_polytope").make(problem, find_wrench_solver("facets").make());
  });
  EXPECT_THROW(find_search("slp").make()->maximize(*objective, {}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
