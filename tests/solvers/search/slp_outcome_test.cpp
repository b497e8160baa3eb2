#include "solvers/search/slp_outcome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/search/slp_run.h"
#include "tests/support/objectives.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// What a table is worth, by a general solver.
double worth_of(const Problem& problem, const Eigen::VectorXd& x) {
  TrajectoryEvaluator trajectories(problem, Wrench::kPure, find_trajectory_solver("clp").make);
  if (trajectories.evaluate(unstacked(x, knots_of(problem))).status != Status::kOptimal) {
    return -kInfinity;
  }
  trajectories.evaluate_between_knots();
  const Trajectory& trajectory = trajectories.trajectory();
  return trajectory.between_knots_reason.empty()
             ? std::min(trajectory.value, trajectory.value_between_knots)
             : -kInfinity;
}

/// A task whose balance holds at the knots alone, so that local searches make the most of what
/// happens in between; the default posture throughout, and the end of a local search from there.
struct Loose {
  explicit Loose(const char* name, long climbed) : problem(load_problem(name)) {
    problem.motion->instants_per_interval = 1;
    objective = make_trajectory_objective(problem, Wrench::kPure,
                                          find_trajectory_solver("facets_or_ipm").make, true,
                                          TrajectoryValue::kThroughout);
    start.theta_r = problem.theta_r_default.replicate(problem.motion->k, 1);
    start.value = objective->copy(TrajectoryValue::kAtInstants)->evaluate(start.theta_r);
    slp_run = std::make_unique<SlpRun>(*objective, start, quiet_run());
    slp_run->optimise(climbed);
  }
  /// The start, which is worth something.
  SlpOutcome outcome() const {
    SlpOutcome outcome;
    outcome.trajectory = start;
    outcome.worth = worth_of(problem, start.theta_r);
    return outcome;
  }
  Problem problem;
  std::unique_ptr<TrajectoryObjective> objective;
  Candidate start;
  std::unique_ptr<SlpRun> slp_run;
};

/// The share of the way from a to b at which x lies; x is nowhere else.
double share_of_way(const Eigen::VectorXd& x, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const double share = (x - a).dot(b - a) / (b - a).squaredNorm();
  EXPECT_LT((x - a - share * (b - a)).norm(), 1e-12);
  return share;
}

TEST(SlpOutcome, SLOW_ATrajectoryWorthNothingGoesBackSomeOfTheWay) {
  for (const auto& [name, climbed] :
       {std::pair("planar/trajectory", 100), std::pair("uvms/valve_trajectory", 20)}) {
    const Loose task(name, climbed);
    SlpOutcome outcome = task.outcome();
    const double before = outcome.worth;
    const Eigen::VectorXd end = task.slp_run->best().theta_r;
    ASSERT_GT(before, -kInfinity);
    ASSERT_EQ(worth_of(task.problem, end), -kInfinity) << name;
    ASSERT_GT(task.slp_run->value(), before);
    const long spent = task.slp_run->found().trace.evaluations();
    long shown = 0;
    SearchOptions options;
    options.progress = [&](long count) { shown = count; };
    SearchRun run(options);
    judge(*task.slp_run, run, outcome);
    EXPECT_LE(shown, kJudged);
    EXPECT_EQ(task.slp_run->found().trace.evaluations(), spent + shown);
    EXPECT_GT(outcome.worth, before) << name;
    EXPECT_NEAR(worth_of(task.problem, outcome.trajectory.theta_r), outcome.worth, 1e-6) << name;
    // As far as it can go: from further on the way nothing more is worth than before.
    const double share = share_of_way(outcome.trajectory.theta_r, task.start.theta_r, end);
    bool listed = false;
    for (const double retreat : kRetreats) {
      listed = listed || std::abs(share - retreat) < 1e-12;
      if (retreat < share + 1e-12) continue;
      const Eigen::VectorXd further = task.start.theta_r + retreat * (end - task.start.theta_r);
      EXPECT_LE(worth_of(task.problem, further), before) << name << ' ' << retreat;
    }
    EXPECT_TRUE(listed) << share;
  }
}

TEST(SlpOutcome, NothingOnTheWayIsWorthAsMuch) {
  const Loose task("planar/trajectory", 100);
  SlpOutcome outcome = task.outcome();
  outcome.worth = outcome.trajectory.value = 100;  // no trajectory exerts that
  judge(*task.slp_run, quiet_run(), outcome);
  EXPECT_EQ(outcome.worth, 100);
  EXPECT_EQ(outcome.trajectory.theta_r, task.start.theta_r);
}

TEST(SlpOutcome, ATrajectoryWorthSomethingStaysWhereItIs) {
  const Loose task("planar/trajectory", 20);
  SlpOutcome outcome = task.outcome();
  const Eigen::VectorXd end = task.slp_run->best().theta_r;
  const double worth = worth_of(task.problem, end);
  ASSERT_GT(worth, outcome.worth);
  judge(*task.slp_run, quiet_run(), outcome);
  EXPECT_EQ(outcome.trajectory.theta_r, end);
  EXPECT_NEAR(outcome.worth, worth, 1e-6);
}

/// Without anything worth something there is nowhere to go back to: the higher value stays.
TEST(SlpOutcome, WhereNothingIsWorthAnythingTheValueCounts) {
  const Loose task("planar/trajectory", 100);
  SlpOutcome outcome;
  judge(*task.slp_run, quiet_run(), outcome);
  EXPECT_EQ(outcome.worth, -kInfinity);
  EXPECT_EQ(outcome.trajectory.theta_r, task.slp_run->best().theta_r);
}

TEST(SlpOutcome, WhatIsWorthMoreImproves) {
  SlpOutcome outcome;
  outcome.trajectory.value = 3;
  outcome.worth = 2;
  EXPECT_TRUE(outcome.improves(2.1, 2.1, 0));
  EXPECT_FALSE(outcome.improves(2, 9, 0));            // its value does not count
  EXPECT_FALSE(outcome.improves(-kInfinity, 9, 0));   // nor here
  EXPECT_FALSE(outcome.improves(2.1, 2.1, 0.1 / 3));  // by 0.1 = margin (1 + 2)
  EXPECT_TRUE(outcome.improves(2.1, 2.1, 0.09 / 3));
  outcome.worth = -kInfinity;
  EXPECT_TRUE(outcome.improves(-9, 0, 0));            // worth something, at whatever value
  EXPECT_TRUE(outcome.improves(-kInfinity, 3.1, 0));  // neither is: the higher value
  EXPECT_FALSE(outcome.improves(-kInfinity, 3, 0));
  outcome.trajectory.value = -kInfinity;  // nothing found so far
  EXPECT_TRUE(outcome.improves(-kInfinity, -9, 1));
  EXPECT_FALSE(outcome.improves(-kInfinity, -kInfinity, 0));
}

}  // namespace
}  // namespace maxwrench
