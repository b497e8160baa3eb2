#include "maxwrench/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/row.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

PlanSolverMaker solver(const char* name = "ipm") { return find_plan_solver(name).make; }

/// Values of an independent model of the same robot (N m): `uvms/valve` turned by pi in 5 s.
struct KnownTurn {
  Scheme scheme;
  Wrench wrench;
  double value;
};
constexpr KnownTurn kKnownTurns[] = {{Scheme::kForward, Wrench::kPure, 34.17591},
                                     {Scheme::kEnds, Wrench::kPure, 34.36105},
                                     {Scheme::kSpline, Wrench::kPure, 34.30190},
                                     {Scheme::kEnds, Wrench::kAny, 40.78087}};

TEST(Plan, OfAFixedPostureIsThatOfAnIndependentModel) {
  Problem problem = load_problem("uvms/valve_trajectory");
  for (const KnownTurn& known : kKnownTurns) {
    problem.motion->scheme = known.scheme;
    PlanEvaluator evaluator(problem, known.wrench, solver());
    const Plan& plan = evaluator.evaluate(
        constant_knots(problem, Eigen::Vector4d(3.0643, 0.6895, 0.4288, -3.0278)));
    ASSERT_EQ(plan.status, Status::kOptimal) << plan.reason.c_str();
    EXPECT_NEAR(plan.value, known.value, 1e-5);
    EXPECT_TRUE(plan.solution.residual.within(1e-7));
    evaluator.evaluate_continuous();
    if (known.wrench == Wrench::kPure) {
      EXPECT_NEAR(plan.continuous, 34.30164, 1e-5);
    }
  }
}

TEST(Plan, OfOneKnotIsTheStaticValue) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->k = 1;
  const Problem still = load_problem("uvms/valve");
  // Beside the kink of the best posture, where gradients differ.
  const Eigen::VectorXd theta_r = problem.theta_r_default + Eigen::Vector4d(0.03, 0.02, 0.05, 0.02);
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    problem.motion->scheme = scheme;
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      PlanEvaluator evaluator(problem, wrench, solver());
      const Plan& plan = evaluator.evaluate(constant_knots(problem, theta_r));
      Case c;
      c.search.clear();
      c.wrench = wrench;
      const Answer row = evaluate(still, theta_r, {c});
      ASSERT_EQ(plan.status, Status::kOptimal);
      EXPECT_NEAR(plan.value, row.capability.beta, 1e-8);
      EXPECT_TRUE(plan.gradient.isApprox(row.plan.gradient, 1e-5));
    }
  }
  // So is a static task.
  PlanEvaluator evaluator(still, Wrench::kPure, solver());
  EXPECT_NEAR(evaluator.evaluate(problem.theta_r_default.transpose()).value, 35.4083, 1e-4);
}

TEST(Plan, WithoutRatesIsTheLeastOfItsInstants) {
  // Each instant by itself is a program of one block; without rates nothing else joins them.
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->rates = false;
  PlanEvaluator evaluator(problem, Wrench::kPure, solver());
  const Plan plan = evaluator.evaluate(constant_knots(problem, problem.theta_r_default));
  ASSERT_EQ(plan.status, Status::kOptimal);
  double least = kInfinity;
  const auto alone = find_plan_solver("simplex").make();
  for (const Instant& instant : plan.instants) {
    PlanProgram program;
    program.instants = {make_wrench_program(problem, Wrench::kPure)};
    program.instants[0].tau_d = instant.tau_d;
    program.instants[0].JtW = instant.J.transpose() * problem.c;
    program.first_min = problem.robot.actuation.u_min;
    program.first_max = problem.robot.actuation.u_max;
    program.du_max.resize(problem.robot.actuators(), 0);
    PlanSolution solution;
    alone->solve(program, solution);
    ASSERT_EQ(solution.status, Status::kOptimal);
    least = std::min(least, solution.value);
  }
  EXPECT_NEAR(plan.value, least, 1e-8);
}

TEST(Plan, OfAHeaveAtRestIsTheStaticValue) {
  for (const Scheme scheme : {Scheme::kSpline, Scheme::kForward, Scheme::kBackward}) {
    Problem problem = load_problem("uvms/valve_impulse");
    problem.motion->scheme = scheme;
    PlanEvaluator evaluator(problem, Wrench::kPure, solver());
    const Plan& plan = evaluator.evaluate(constant_knots(problem, problem.theta_r_default));
    ASSERT_EQ(plan.status, Status::kOptimal) << plan.reason.c_str();
    EXPECT_NEAR(plan.value, 35.4083, 1e-4);
    EXPECT_EQ(plan.instants.front().v.norm(), 0);
    EXPECT_EQ(plan.t_h, 3);
  }
}

TEST(Plan, BestKnotOfAHeaveIsTheBestOfAll) {
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->scheme = Scheme::kBackward;
  Random random(3);
  Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  for (double& q : knots.reshaped()) q += random.uniform(-0.05, 0.05);
  problem.robot.collision = nullptr;
  double best = -kInfinity;
  int at = 0;
  for (int t_h = 1; t_h <= problem.motion->k; ++t_h) {
    problem.motion->t_h = t_h;
    const double value = PlanEvaluator(problem, Wrench::kPure, solver()).evaluate(knots).value;
    if (value > best) {
      best = value;
      at = t_h;
    }
  }
  problem.motion->t_h = 0;
  PlanEvaluator evaluator(problem, Wrench::kPure, solver());
  const Plan& plan = evaluator.evaluate(knots);
  EXPECT_NEAR(plan.value, best, 1e-8);
  EXPECT_EQ(plan.t_h, at);
}

TEST(Plan, StartsOfAHeaveAreOrdered) {
  // A free u_0 allows what any other start does, and w_0 <= beta_0 what w_0 = 0 does.
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->T = 0.4;  // short, so that the rates of efforts bind
  const auto value = [&](Start start) {
    problem.motion->start = start;
    PlanEvaluator evaluator(problem, Wrench::kPure, solver());
    return evaluator.evaluate(constant_knots(problem, problem.theta_r_default)).value;
  };
  const double still = value(Start::kStatic), rest = value(Start::kRest),
               zero = value(Start::kZero), free = value(Start::kFree);
  EXPECT_GE(free, still - 1e-8);
  EXPECT_GE(still, rest - 1e-8);
  EXPECT_FALSE(zero > free + 1e-8);  // or it has no value: 2 N are reached until the first instant
  EXPECT_LT(rest, still - 1);
}

TEST(Plan, ElasticValueIsTheHardOneWhereThatExists) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  PlanEvaluator evaluator(problem, Wrench::kPure, solver());
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  const double hard = evaluator.evaluate(knots).value;
  EXPECT_NEAR(evaluator.evaluate_elastic(knots, nullptr), hard, 1e-7);
  // Turned three times as fast the fixed posture has no answer, but an elastic one.
  Problem fast = problem;
  fast.motion->T = 1.2;
  fast.motion->path = Path::screw(fast.pose, {0, 0, 1}, {0, 0, 0}, std::numbers::pi, {0, 0, 0},
                                  Timing::kCubic, 1.2);
  fast.motion->scheme = Scheme::kEnds;
  PlanEvaluator quick(fast, Wrench::kPure, solver());
  EXPECT_EQ(quick.evaluate(knots).status, Status::kInfeasible);
  EXPECT_GT(quick.evaluate_elastic(knots, nullptr), -kInfinity);
}

TEST(Plan, InvalidTablesNameKnotsAndJoint) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  PlanEvaluator evaluator(problem, Wrench::kPure, solver());
  Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  knots(3, 1) = 4;
  EXPECT_EQ(evaluator.evaluate(knots).status, Status::kInvalidPosture);
  EXPECT_NE(evaluator.plan().reason.str().find("knot 4: q2_shoulder_pitch at 4"), std::string::npos)
      << evaluator.plan().reason.c_str();
  knots = constant_knots(problem, problem.theta_r_default);
  knots(5, 0) += 0.5;  // 0.9 rad/s over 5/9 s, 0.5 allowed
  EXPECT_EQ(evaluator.evaluate(knots).status, Status::kInvalidPosture);
  EXPECT_NE(evaluator.plan().reason.str().find("speed limit: knots 5 and 6: q1_shoulder_yaw"),
            std::string::npos)
      << evaluator.plan().reason.c_str();
  EXPECT_THROW(evaluator.evaluate(knots.topRows(4)), std::invalid_argument);
  knots(0, 0) = std::nan("");
  EXPECT_THROW(evaluator.evaluate(knots), std::invalid_argument);
}

TEST(Plan, KnotsThatCollideAreReportedAndAvoided) {
  // At the lower limits of q2 and q3 the forearm is folded back onto the base.
  const Problem problem = load_problem("uvms/valve_trajectory");
  Eigen::VectorXd folded = problem.theta_r_default;
  folded[2] = problem.theta_r_min[2];
  PlanEvaluator evaluator(problem, Wrench::kPure, solver());
  const Plan& plan = evaluator.evaluate(constant_knots(problem, folded));
  EXPECT_NE(plan.status, Status::kInvalidPosture);
  EXPECT_NE(plan.collision.str().find("self-collision: knot 1: "), std::string::npos)
      << plan.collision.c_str();
  EXPECT_EQ(evaluator.evaluate_elastic(constant_knots(problem, folded), nullptr), -kInfinity);
  EXPECT_EQ(evaluator.plan().status, Status::kInvalidPosture);
  PlanEvaluator blind(problem, Wrench::kPure, solver(), false);
  EXPECT_TRUE(blind.evaluate(constant_knots(problem, folded)).collision.empty());
}

TEST(Plan, ServesNoSecondContact) {
  const Problem problem = load_problem("dual_arm/bar_wall");
  EXPECT_THROW(PlanEvaluator(problem, Wrench::kPure, solver()), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
