#include "solvers/search/slp_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "tests/support/objectives.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

std::unique_ptr<TrajectoryObjective> elastic_value(const Problem& problem,
                                                   Wrench wrench = Wrench::kPure) {
  return make_trajectory_objective(problem, wrench, find_trajectory_solver("facets_or_ipm").make);
}

/// The task's default posture throughout.
VectorXd default_table(const Problem& problem) {
  return problem.theta_r_default.replicate(problem.motion->k, 1);
}

SlpRun slp_run_from(const std::unique_ptr<TrajectoryObjective>& objective, const VectorXd& x,
                    bool alike = false) {
  return {*objective, {x, evaluate_one(*objective, x)}, quiet_run(), alike};
}

/// The hard program of a table, by a general solver.
Trajectory confirmed_trajectory(const Problem& problem, const VectorXd& x,
                                Wrench wrench = Wrench::kPure) {
  TrajectoryEvaluator trajectories(problem, wrench, find_trajectory_solver("glpk").make);
  return trajectories.evaluate(unstacked(x, knots_of(problem)));
}

/// How far a table is beyond its bounds and rows.
double table_violation(Objective& objective, const VectorXd& x) {
  const KnotRows& rows = *objective.rows();
  const VectorXd at = rows.R * x;
  return std::max({0.0, (x - objective.upper()).maxCoeff(), (objective.lower() - x).maxCoeff(),
                   (at - rows.r_max).maxCoeff(), (rows.r_min - at).maxCoeff()});
}

TEST(SlpRun, RisesWithinItsShare) {
  const Problem problem = load_problem("planar/trajectory");
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    double before = -kInfinity;
    for (const long share : {0, 2, 3, 10, 40}) {
      SlpRun slp_run = slp_run_from(elastic_value(problem, wrench), default_table(problem));
      const double start = slp_run.value();
      slp_run.optimise(share);
      EXPECT_LE(slp_run.found().trace.evaluations(), share);
      if (share < 3) {
        EXPECT_EQ(slp_run.found().trace.evaluations(), 0);
      }
      EXPECT_GE(slp_run.value(), std::max(start, before)) << share;
      EXPECT_EQ(slp_run.best().value, slp_run.value());
      before = slp_run.value();
    }
    SlpRun slp_run = slp_run_from(elastic_value(problem, wrench), default_table(problem));
    slp_run.optimise(40);
    const Trajectory trajectory = confirmed_trajectory(problem, slp_run.at().theta_r, wrench);
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    EXPECT_NEAR(trajectory.value, slp_run.value(), 1e-7);
    EXPECT_GT(slp_run.value(),
              1.5 * confirmed_trajectory(problem, default_table(problem), wrench).value);
  }
}

/// In several goes it does what it does in one.
TEST(SlpRun, GoesOnWhereItWas) {
  const Problem problem = load_problem("planar/trajectory");
  SlpRun once = slp_run_from(elastic_value(problem), default_table(problem));
  SlpRun often = slp_run_from(elastic_value(problem), default_table(problem));
  once.optimise(41);
  for (const long until : {11, 21, 31, 41}) often.optimise(until);
  EXPECT_EQ(once.at().theta_r, often.at().theta_r);
  EXPECT_EQ(once.found().trace.evaluations(), often.found().trace.evaluations());
}

/// One knot at rest is a posture, so a fine grid of postures, each by its facets, is another way to
/// the maximum: no point of one around the end of a local search is better, and the best end is as
/// good as the best point of one over all postures.
TEST(SlpRun, EndsWhereAGridOfPosturesDoes) {
  const Problem problem = load_problem("planar/force");
  const auto posture = make_capability_objective(problem, Wrench::kPure, [&] {
    return find_measure("linf_polytope").make(problem, find_wrench_solver("facets").make());
  });
  const Eigen::Array2d low = problem.theta_r_min, range = problem.theta_r_max - problem.theta_r_min;
  const auto grid = [&](int points, const auto& visit) {
    for (int i = 0; i < points; ++i) {
      for (int j = 0; j < points; ++j) visit(Eigen::Array2d(i, j) / (points - 1));
    }
  };
  double best = -kInfinity, best_end = -kInfinity;
  grid(101, [&](const Eigen::Array2d& at) {
    best = std::max(best, posture->evaluate((low + at * range).matrix()));
  });
  int local_searches = 0;
  grid(5, [&](const Eigen::Array2d& at) {
    const VectorXd start = low + at * range;
    if (posture->evaluate(start) == -kInfinity) return;
    SlpRun slp_run = slp_run_from(elastic_value(problem), start);
    slp_run.optimise(400);
    ++local_searches;
    const Eigen::Array2d end = slp_run.at().theta_r;
    EXPECT_NEAR(posture->evaluate(end.matrix()), slp_run.value(), 1e-9);
    best_end = std::max(best_end, slp_run.value());
    grid(9, [&](const Eigen::Array2d& near) {
      const VectorXd beside =
          (end + 0.02 * (near - 0.5)).max(low).min(problem.theta_r_max.array()).matrix();
      EXPECT_LE(posture->evaluate(beside), slp_run.value() + 1e-6) << start.transpose();
    });
  });
  EXPECT_GT(local_searches, 10);
  EXPECT_GE(best_end, best - 1e-9);
}

/// Joints that may hardly move: what the local search finds goes to their speed limits and no
/// further.
TEST(SlpRun, KeepsSpeedLimits) {
  Problem problem = load_problem("planar/trajectory");
  for (Joint& joint : problem.robot.joints) joint.velocity_max = 0.01;
  const auto objective = elastic_value(problem);
  SlpRun slp_run = slp_run_from(elastic_value(problem), default_table(problem));
  slp_run.optimise(60);
  const VectorXd& x = slp_run.at().theta_r;
  EXPECT_LE(table_violation(*objective, x), 1e-9);
  const VectorXd at = objective->rows()->R * x;
  EXPECT_LT((objective->rows()->r_max - at).minCoeff(), 1e-6);
  EXPECT_EQ(confirmed_trajectory(problem, x).status, Status::kOptimal);
}

TEST(SlpRun, KeepsTheBoundsThatItStartsAt) {
  const Problem problem = load_problem("planar/trajectory");
  const auto objective = elastic_value(problem);
  for (const bool alike : {false, true}) {
    SlpRun slp_run = slp_run_from(elastic_value(problem), objective->upper(), alike);
    ASSERT_GT(slp_run.value(), -kInfinity);
    const double start = slp_run.value();
    slp_run.optimise(30);
    EXPECT_LE(table_violation(*objective, slp_run.at().theta_r), 1e-9);
    EXPECT_GE(slp_run.value(), start);
  }
}

/// The default posture is as near to itself as it may be, and steps from there lead into collision,
/// at knots and, where they count, between them.
TEST(SlpRun, MovesBodiesApart) {
  for (const bool at_instants : {false, true}) {
    Problem problem = load_problem("uvms/valve_trajectory");
    problem.motion->clear_at_instants = at_instants;
    SlpRun slp_run = slp_run_from(elastic_value(problem), default_table(problem));
    TrajectoryEvaluator trajectories(problem, Wrench::kPure, find_trajectory_solver("ipm").make);
    const auto least = [&](const VectorXd& x) {
      double clearance = 1;
      for (const NearPair& pair : trajectories.near_pairs(unstacked(x, knots_of(problem)), 1)) {
        clearance = std::min(clearance, pair.clearance);
      }
      return clearance;
    };
    ASSERT_LT(least(slp_run.at().theta_r), 1e-6);
    const double start = slp_run.value();
    slp_run.optimise(20);
    EXPECT_GT(slp_run.value(), start + 1);
    EXPECT_GE(least(slp_run.at().theta_r), 0);
    EXPECT_TRUE(trajectories.evaluate(unstacked(slp_run.at().theta_r, knots_of(problem)))
                    .collision.empty());
  }
}

/// Bounds that differ from knot to knot, and a start whose knots differ: a step that all knots
/// share leaves none of the bounds, so what the knots differ by stays.
TEST(SlpRun, KnotsThatMoveAlikeKeepTheNearestBound) {
  const Problem problem = load_problem("planar/trajectory");
  VectorXd start = default_table(problem);
  const auto whole = elastic_value(problem);
  SlpRun free = slp_run_from(elastic_value(problem), start, true);
  free.optimise(30);
  const VectorXd step = free.at().theta_r - start;
  ASSERT_GT(step.lpNorm<Eigen::Infinity>(), 0.3);
  // The fourth knot may go a tenth of that way; the last one begins 0.05 further.
  const Eigen::Index r = problem.redundancy(), fourth = 3 * r, last = step.size() - r;
  VectorXd lower = whole->lower(), upper = whole->upper();
  for (Eigen::Index j = 0; j < r; ++j) {
    (step[j] > 0 ? upper : lower)[fourth + j] = start[fourth + j] + 0.1 * step[j];
    start[last + j] += 0.05;
  }
  const auto bounded = [&]() -> std::unique_ptr<TrajectoryObjective> {
    return std::make_unique<OtherBounds>(elastic_value(problem), lower, upper);
  };
  SlpRun slp_run = slp_run_from(bounded(), start, true);
  const double before = slp_run.value();
  slp_run.optimise(30);
  EXPECT_GT(slp_run.value(), before);
  const VectorXd moved = slp_run.at().theta_r - start;
  EXPECT_GT(moved.lpNorm<Eigen::Infinity>(), 0.02);
  EXPECT_LT((moved - moved.head(r).replicate(problem.motion->k, 1)).norm(), 1e-7);
  EXPECT_LE(table_violation(*bounded(), slp_run.at().theta_r), 0);
}

/// A fixed posture is too slow for this turn: slack makes up for it, until the local search needs
/// none.
TEST(SlpRun, SLOW_LeavesSlackBehind) {
  Problem problem = load_problem("uvms/valve_trajectory_fast");
  problem.motion->scheme = Scheme::kEnds;
  SlpRun slp_run = slp_run_from(elastic_value(problem), default_table(problem));
  EXPECT_EQ(confirmed_trajectory(problem, slp_run.at().theta_r).status, Status::kInfeasible);
  slp_run.optimise(100);
  const Trajectory trajectory = confirmed_trajectory(problem, slp_run.at().theta_r);
  ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
  EXPECT_NEAR(trajectory.value, slp_run.value(), 1e-6);
}

TEST(SlpRun, EndsAtOnceWhereThereIsNoValue) {
  const Problem problem = load_problem("planar/trajectory");
  VectorXd jump = default_table(problem);
  jump[2] = 1e3;  // no joint gets there
  SlpRun slp_run(*elastic_value(problem), {jump, 1}, quiet_run());
  slp_run.optimise(50);
  EXPECT_EQ(slp_run.found().trace.evaluations(), 1);
  EXPECT_EQ(slp_run.at().theta_r, jump);
  SearchOptions options;
  const Interruption interruption(5, options);
  SearchRun run(options);
  SlpRun interrupted(*elastic_value(problem), {default_table(problem), 0}, run);
  interrupted.optimise(50);
  EXPECT_EQ(interrupted.found().trace.evaluations(), 5 - interruption.left());
  EXPECT_GE(interruption.left(), -1);  // a linear program follows an evaluation
}

/// Each step's linear program is a call, and an evaluation without a value.
TEST(SlpRun, SaysWhoseLinearProgramsItsStepsUsed) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  SlpRun slp_run = slp_run_from(elastic_value(problem), default_table(problem));
  slp_run.optimise(30);
  long by_facets = 0, by_ipm = 0;
  for (const Call& call : slp_run.found().calls) {
    EXPECT_EQ(call.method, "slp");
    EXPECT_EQ(call.evaluations, 1);
    ++(call.status == "facets" ? by_facets : by_ipm);
    EXPECT_TRUE(call.status == "facets" || call.status == "ipm") << call.status;
  }
  EXPECT_GT(by_facets + by_ipm, 5);
  EXPECT_LT(by_facets + by_ipm, 30);
}

TEST(SlpRun, ATrajectoryIsWorthTheLessOfItsInstantsAndWhatIsBetweenThem) {
  Problem problem = load_problem("planar/trajectory");
  const Candidate trajectory{default_table(problem), 7};  // its value is taken as it is given
  TrajectoryEvaluator trajectories(problem, Wrench::kPure, find_trajectory_solver("clp").make);
  trajectories.evaluate(unstacked(trajectory.theta_r, knots_of(problem)));
  trajectories.evaluate_between_knots();
  const double between = trajectories.trajectory().value_between_knots;
  const auto throughout = [&] {
    return elastic_value(problem)->copy(TrajectoryValue::kThroughout);
  };
  SlpRun slp_run(*throughout(), trajectory, quiet_run());
  EXPECT_NEAR(slp_run.worth(trajectory), between, 1e-7);
  EXPECT_EQ(slp_run.worth({trajectory.theta_r, between / 2}), between / 2);
  EXPECT_NEAR(slp_run.found().best.value, between, 1e-7);
  EXPECT_NEAR(throughout()->evaluate(trajectory.theta_r), between,
              1e-7);  // at its instants it has more
  EXPECT_EQ(slp_run.found().trace.evaluations(), 2 * SlpRun::kJudgement);
  slp_run.optimise(50);  // it has ended
  EXPECT_EQ(slp_run.found().trace.evaluations(), 2 * SlpRun::kJudgement);
  // To another objective nothing counts between them; and other schemes do not say what is there.
  SlpRun at_instants = slp_run_from(elastic_value(problem), trajectory.theta_r);
  EXPECT_EQ(at_instants.worth(trajectory), 7);
  problem.motion->scheme = Scheme::kEnds;
  SlpRun coarse(*throughout(), trajectory, quiet_run());
  EXPECT_EQ(coarse.worth(trajectory), 7);
  EXPECT_EQ(coarse.found().trace.evaluations(), 0);
}

}  // namespace
}  // namespace maxwrench
