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

std::unique_ptr<PlanObjective> elastic_value(const Problem& problem,
                                             Wrench wrench = Wrench::kPure) {
  return make_plan_objective(problem, wrench, find_plan_solver("structured").make);
}

/// The task's default posture throughout.
VectorXd default_table(const Problem& problem) {
  return problem.theta_r_default.replicate(problem.motion->k, 1);
}

KnotClimber climber_from(const std::unique_ptr<PlanObjective>& objective, const VectorXd& x,
                         bool alike = false) {
  return {*objective, {x, evaluate_one(*objective, x)}, quiet_run(), alike};
}

/// The hard program of a table, by a general solver.
Plan confirmed_plan(const Problem& problem, const VectorXd& x, Wrench wrench = Wrench::kPure) {
  PlanEvaluator plans(problem, wrench, find_plan_solver("glpk").make);
  return plans.evaluate(unstacked(x, knots_of(problem)));
}

/// How far a table is beyond its bounds and rows.
double table_violation(Objective& objective, const VectorXd& x) {
  const KnotRows& rows = *objective.rows();
  const VectorXd at = rows.R * x;
  return std::max({0.0, (x - objective.upper()).maxCoeff(), (objective.lower() - x).maxCoeff(),
                   (at - rows.r_max).maxCoeff(), (rows.r_min - at).maxCoeff()});
}

TEST(KnotClimber, RisesWithinItsShare) {
  const Problem problem = load_problem("planar/trajectory");
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    double before = -kInfinity;
    for (const long share : {0, 2, 3, 10, 40}) {
      KnotClimber climber = climber_from(elastic_value(problem, wrench), default_table(problem));
      const double start = climber.value();
      climber.climb(share);
      EXPECT_LE(climber.found().trace.evaluations(), share);
      if (share < 3) {
        EXPECT_EQ(climber.found().trace.evaluations(), 0);
      }
      EXPECT_GE(climber.value(), std::max(start, before)) << share;
      EXPECT_EQ(climber.best().value, climber.value());
      before = climber.value();
    }
    KnotClimber climber = climber_from(elastic_value(problem, wrench), default_table(problem));
    climber.climb(40);
    const Plan plan = confirmed_plan(problem, climber.at().theta_r, wrench);
    ASSERT_EQ(plan.status, Status::kOptimal) << plan.reason.c_str();
    EXPECT_NEAR(plan.value, climber.value(), 1e-7);
    EXPECT_GT(climber.value(), 1.5 * confirmed_plan(problem, default_table(problem), wrench).value);
  }
}

/// In several goes it does what it does in one.
TEST(KnotClimber, GoesOnWhereItWas) {
  const Problem problem = load_problem("planar/trajectory");
  KnotClimber once = climber_from(elastic_value(problem), default_table(problem));
  KnotClimber often = climber_from(elastic_value(problem), default_table(problem));
  once.climb(41);
  for (const long until : {11, 21, 31, 41}) often.climb(until);
  EXPECT_EQ(once.at().theta_r, often.at().theta_r);
  EXPECT_EQ(once.found().trace.evaluations(), often.found().trace.evaluations());
}

/// One knot at rest is a posture, so a fine grid of postures, each by its facets, is another way to
/// the maximum: no point of one around the end of a climb is better, and the best end is as good as
/// the best point of one over all postures.
TEST(KnotClimber, EndsWhereAGridOfPosturesDoes) {
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
  int climbs = 0;
  grid(5, [&](const Eigen::Array2d& at) {
    const VectorXd start = low + at * range;
    if (posture->evaluate(start) == -kInfinity) return;
    KnotClimber climber = climber_from(elastic_value(problem), start);
    climber.climb(400);
    ++climbs;
    const Eigen::Array2d end = climber.at().theta_r;
    EXPECT_NEAR(posture->evaluate(end.matrix()), climber.value(), 1e-9);
    best_end = std::max(best_end, climber.value());
    grid(9, [&](const Eigen::Array2d& near) {
      const VectorXd beside =
          (end + 0.02 * (near - 0.5)).max(low).min(problem.theta_r_max.array()).matrix();
      EXPECT_LE(posture->evaluate(beside), climber.value() + 1e-6) << start.transpose();
    });
  });
  EXPECT_GT(climbs, 10);
  EXPECT_GE(best_end, best - 1e-9);
}

/// Joints that may hardly move: what the climb finds goes to their speed limits and no further.
TEST(KnotClimber, KeepsSpeedLimits) {
  Problem problem = load_problem("planar/trajectory");
  for (Joint& joint : problem.robot.joints) joint.velocity_max = 0.01;
  const auto objective = elastic_value(problem);
  KnotClimber climber = climber_from(elastic_value(problem), default_table(problem));
  climber.climb(60);
  const VectorXd& x = climber.at().theta_r;
  EXPECT_LE(table_violation(*objective, x), 1e-9);
  const VectorXd at = objective->rows()->R * x;
  EXPECT_LT((objective->rows()->r_max - at).minCoeff(), 1e-6);
  EXPECT_EQ(confirmed_plan(problem, x).status, Status::kOptimal);
}

TEST(KnotClimber, KeepsTheBoundsThatItStartsAt) {
  const Problem problem = load_problem("planar/trajectory");
  const auto objective = elastic_value(problem);
  for (const bool alike : {false, true}) {
    KnotClimber climber = climber_from(elastic_value(problem), objective->upper(), alike);
    ASSERT_GT(climber.value(), -kInfinity);
    const double start = climber.value();
    climber.climb(30);
    EXPECT_LE(table_violation(*objective, climber.at().theta_r), 1e-9);
    EXPECT_GE(climber.value(), start);
  }
}

/// The default posture is as near to itself as it may be, and steps from there lead into collision.
TEST(KnotClimber, MovesKnotsApart) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  KnotClimber climber = climber_from(elastic_value(problem), default_table(problem));
  PlanEvaluator plans(problem, Wrench::kPure, find_plan_solver("ipm").make);
  const auto least = [&](const VectorXd& x) {
    double clearance = 1;
    for (const NearPair& pair : plans.near_pairs(unstacked(x, knots_of(problem)), 1)) {
      clearance = std::min(clearance, pair.clearance);
    }
    return clearance;
  };
  ASSERT_LT(least(climber.at().theta_r), 1e-6);
  const double start = climber.value();
  climber.climb(20);
  EXPECT_GT(climber.value(), start + 1);
  EXPECT_GE(least(climber.at().theta_r), 0);
  EXPECT_TRUE(plans.evaluate(unstacked(climber.at().theta_r, knots_of(problem))).collision.empty());
}

/// Bounds that differ from knot to knot, and a start whose knots differ: a step that all knots
/// share leaves none of the bounds, so what the knots differ by stays.
TEST(KnotClimber, KnotsThatMoveAlikeKeepTheNearestBound) {
  const Problem problem = load_problem("planar/trajectory");
  VectorXd start = default_table(problem);
  const auto whole = elastic_value(problem);
  KnotClimber free = climber_from(elastic_value(problem), start, true);
  free.climb(30);
  const VectorXd step = free.at().theta_r - start;
  ASSERT_GT(step.lpNorm<Eigen::Infinity>(), 0.3);
  // The fourth knot may go a tenth of that way; the last one begins 0.05 further.
  const Eigen::Index r = problem.redundancy(), fourth = 3 * r, last = step.size() - r;
  VectorXd lower = whole->lower(), upper = whole->upper();
  for (Eigen::Index j = 0; j < r; ++j) {
    (step[j] > 0 ? upper : lower)[fourth + j] = start[fourth + j] + 0.1 * step[j];
    start[last + j] += 0.05;
  }
  const auto bounded = [&]() -> std::unique_ptr<PlanObjective> {
    return std::make_unique<OtherBounds>(elastic_value(problem), lower, upper);
  };
  KnotClimber climber = climber_from(bounded(), start, true);
  const double before = climber.value();
  climber.climb(30);
  EXPECT_GT(climber.value(), before);
  const VectorXd moved = climber.at().theta_r - start;
  EXPECT_GT(moved.lpNorm<Eigen::Infinity>(), 0.02);
  EXPECT_LT((moved - moved.head(r).replicate(problem.motion->k, 1)).norm(), 1e-7);
  EXPECT_LE(table_violation(*bounded(), climber.at().theta_r), 0);
}

/// A fixed posture is too slow for this turn: slack makes up for it, until the climb needs none.
TEST(KnotClimber, SLOW_LeavesSlackBehind) {
  Problem problem = load_problem("uvms/valve_trajectory_fast");
  problem.motion->scheme = Scheme::kEnds;
  KnotClimber climber = climber_from(elastic_value(problem), default_table(problem));
  EXPECT_EQ(confirmed_plan(problem, climber.at().theta_r).status, Status::kInfeasible);
  climber.climb(100);
  const Plan plan = confirmed_plan(problem, climber.at().theta_r);
  ASSERT_EQ(plan.status, Status::kOptimal) << plan.reason.c_str();
  EXPECT_NEAR(plan.value, climber.value(), 1e-6);
}

TEST(KnotClimber, EndsAtOnceWhereThereIsNoValue) {
  const Problem problem = load_problem("planar/trajectory");
  VectorXd jump = default_table(problem);
  jump[2] = 1e3;  // no joint gets there
  KnotClimber climber(*elastic_value(problem), {jump, 1}, quiet_run());
  climber.climb(50);
  EXPECT_EQ(climber.found().trace.evaluations(), 1);
  EXPECT_EQ(climber.at().theta_r, jump);
  SearchOptions options;
  const Interruption interruption(5, options);
  SearchRun run(options);
  KnotClimber interrupted(*elastic_value(problem), {default_table(problem), 0}, run);
  interrupted.climb(50);
  EXPECT_EQ(interrupted.found().trace.evaluations(), 5 - interruption.left());
  EXPECT_GE(interruption.left(), -1);  // a linear program follows an evaluation
}

/// Each step's linear program is a call, and an evaluation without a value.
TEST(KnotClimber, SaysWhoseLinearProgramsItsStepsUsed) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  KnotClimber climber = climber_from(elastic_value(problem), default_table(problem));
  climber.climb(30);
  long by_facets = 0, by_ipm = 0;
  for (const Call& call : climber.found().calls) {
    EXPECT_EQ(call.method, "slp");
    EXPECT_EQ(call.evaluations, 1);
    ++(call.status == "facets" ? by_facets : by_ipm);
    EXPECT_TRUE(call.status == "facets" || call.status == "ipm") << call.status;
  }
  EXPECT_GT(by_facets + by_ipm, 5);
  EXPECT_LT(by_facets + by_ipm, 30);
}

TEST(KnotClimber, APlanIsWorthTheLessOfItsInstantsAndWhatIsBetweenThem) {
  Problem problem = load_problem("planar/trajectory");
  const Candidate plan{default_table(problem), 7};  // its value is taken as it is given
  PlanEvaluator plans(problem, Wrench::kPure, find_plan_solver("clp").make);
  plans.evaluate(unstacked(plan.theta_r, knots_of(problem)));
  plans.evaluate_continuous();
  const double between = plans.plan().continuous;
  const auto throughout = [&] { return elastic_value(problem)->copy(PlanValue::kThroughout); };
  KnotClimber climber(*throughout(), plan, quiet_run());
  EXPECT_NEAR(climber.worth(plan), between, 1e-7);
  EXPECT_EQ(climber.worth({plan.theta_r, between / 2}), between / 2);
  EXPECT_NEAR(climber.found().best.value, between, 1e-7);
  EXPECT_NEAR(throughout()->evaluate(plan.theta_r), between, 1e-7);  // at its instants it has more
  EXPECT_EQ(climber.found().trace.evaluations(), 2 * KnotClimber::kJudgement);
  climber.climb(50);  // it has ended
  EXPECT_EQ(climber.found().trace.evaluations(), 2 * KnotClimber::kJudgement);
  // To another objective nothing counts between them; and other schemes do not say what is there.
  KnotClimber at_instants = climber_from(elastic_value(problem), plan.theta_r);
  EXPECT_EQ(at_instants.worth(plan), 7);
  problem.motion->scheme = Scheme::kEnds;
  KnotClimber coarse(*throughout(), plan, quiet_run());
  EXPECT_EQ(coarse.worth(plan), 7);
  EXPECT_EQ(coarse.found().trace.evaluations(), 0);
}

}  // namespace
}  // namespace maxwrench
