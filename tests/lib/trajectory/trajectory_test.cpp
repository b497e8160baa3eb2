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

TrajectorySolverMaker solver(const char* name = "ipm") { return find_trajectory_solver(name).make; }

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

TEST(Trajectory, OfAFixedPostureIsThatOfAnIndependentModel) {
  Problem problem = load_problem("uvms/valve_trajectory");
  for (const KnownTurn& known : kKnownTurns) {
    problem.motion->scheme = known.scheme;
    TrajectoryEvaluator evaluator(problem, known.wrench, solver());
    const Trajectory& trajectory = evaluator.evaluate(
        constant_knots(problem, Eigen::Vector4d(3.0643, 0.6895, 0.4288, -3.0278)));
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    EXPECT_NEAR(trajectory.value, known.value, 1e-5);
    EXPECT_TRUE(trajectory.solution.residual.within(1e-7));
    evaluator.evaluate_between_knots();
    if (known.wrench == Wrench::kPure) {
      EXPECT_NEAR(trajectory.value_between_knots, 34.30164, 1e-5);
    }
  }
}

TEST(Trajectory, OfOneKnotIsTheStaticValue) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->k = 1;
  const Problem still = load_problem("uvms/valve");
  // Beside the kink of the best posture, where gradients differ.
  const Eigen::VectorXd theta_r = problem.theta_r_default + Eigen::Vector4d(0.03, 0.02, 0.05, 0.02);
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    problem.motion->scheme = scheme;
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      TrajectoryEvaluator evaluator(problem, wrench, solver());
      const Trajectory& trajectory = evaluator.evaluate(constant_knots(problem, theta_r));
      Case c;
      c.search.clear();
      c.wrench = wrench;
      const Answer row = evaluate(still, theta_r, {c});
      ASSERT_EQ(trajectory.status, Status::kOptimal);
      EXPECT_NEAR(trajectory.value, row.capability.beta, 1e-8);
      EXPECT_TRUE(trajectory.gradient.isApprox(row.trajectory.gradient, 1e-5));
    }
  }
  // So is a static task.
  TrajectoryEvaluator evaluator(still, Wrench::kPure, solver());
  EXPECT_NEAR(evaluator.evaluate(problem.theta_r_default.transpose()).value, 35.4083, 1e-4);
}

TEST(Trajectory, WithoutRatesIsTheLeastOfItsInstants) {
  // Each instant by itself is a program of one block; without rates nothing else joins them.
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->rates = false;
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
  const Trajectory trajectory =
      evaluator.evaluate(constant_knots(problem, problem.theta_r_default));
  ASSERT_EQ(trajectory.status, Status::kOptimal);
  double least = kInfinity;
  const auto alone = find_trajectory_solver("simplex").make();
  for (const Instant& instant : trajectory.instants) {
    TrajectoryProgram program;
    program.instants = {make_wrench_program(problem, Wrench::kPure)};
    program.instants[0].tau_d = instant.tau_d;
    program.instants[0].JtW = instant.J.transpose() * problem.c;
    program.first_min = problem.robot.actuation.u_min;
    program.first_max = problem.robot.actuation.u_max;
    program.du_max.resize(problem.robot.actuators(), 0);
    TrajectorySolution solution;
    alone->solve(program, solution);
    ASSERT_EQ(solution.status, Status::kOptimal);
    least = std::min(least, solution.value);
  }
  EXPECT_NEAR(trajectory.value, least, 1e-8);
}

TEST(Trajectory, OfAImpulseAtRestIsTheStaticValue) {
  for (const Scheme scheme : {Scheme::kSpline, Scheme::kForward, Scheme::kBackward}) {
    Problem problem = load_problem("uvms/valve_impulse");
    problem.motion->scheme = scheme;
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
    const Trajectory& trajectory =
        evaluator.evaluate(constant_knots(problem, problem.theta_r_default));
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    EXPECT_NEAR(trajectory.value, 35.4083, 1e-4);
    EXPECT_EQ(trajectory.instants.front().v.norm(), 0);
    EXPECT_EQ(trajectory.t_h, 3);
  }
}

TEST(Trajectory, BestKnotOfAImpulseIsTheBestOfAll) {
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
    const double value =
        TrajectoryEvaluator(problem, Wrench::kPure, solver()).evaluate(knots).value;
    if (value > best) {
      best = value;
      at = t_h;
    }
  }
  problem.motion->t_h = 0;
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
  const Trajectory& trajectory = evaluator.evaluate(knots);
  EXPECT_NEAR(trajectory.value, best, 1e-8);
  EXPECT_EQ(trajectory.t_h, at);
}

TEST(Trajectory, StartsOfAImpulseAreOrdered) {
  // A free u_0 allows what any other start does, and w_0 <= beta_0 what w_0 = 0 does.
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->T = 0.4;  // short, so that the rates of efforts bind
  const auto value = [&](Start start) {
    problem.motion->start = start;
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
    return evaluator.evaluate(constant_knots(problem, problem.theta_r_default)).value;
  };
  const double still = value(Start::kStatic), rest = value(Start::kRest),
               zero = value(Start::kZero), free = value(Start::kFree);
  EXPECT_GE(free, still - 1e-8);
  EXPECT_GE(still, rest - 1e-8);
  EXPECT_FALSE(zero > free + 1e-8);  // or it has no value: 2 N are reached until the first instant
  EXPECT_LT(rest, still - 1);
}

TEST(Trajectory, ElasticValueIsTheHardOneWhereThatExists) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  const double hard = evaluator.evaluate(knots).value;
  EXPECT_NEAR(evaluator.evaluate_elastic(knots, nullptr), hard, 1e-7);
  // Turned three times as fast the fixed posture has no answer, but an elastic one.
  Problem fast = problem;
  fast.motion->T = 1.2;
  fast.motion->path = Path::screw(fast.pose, {0, 0, 1}, {0, 0, 0}, std::numbers::pi, {0, 0, 0},
                                  Timing::kCubic, 1.2);
  fast.motion->scheme = Scheme::kEnds;
  TrajectoryEvaluator quick(fast, Wrench::kPure, solver());
  EXPECT_EQ(quick.evaluate(knots).status, Status::kInfeasible);
  EXPECT_GT(quick.evaluate_elastic(knots, nullptr), -kInfinity);
}

TEST(Trajectory, InvalidTablesNameKnotsAndJoint) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
  Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  knots(3, 1) = 4;
  EXPECT_EQ(evaluator.evaluate(knots).status, Status::kInvalidPosture);
  EXPECT_NE(evaluator.trajectory().reason.str().find("knot 4: q2_shoulder_pitch at 4"),
            std::string::npos)
      << evaluator.trajectory().reason.c_str();
  knots = constant_knots(problem, problem.theta_r_default);
  knots(5, 0) += 0.5;  // 0.9 rad/s over 5/9 s, 0.5 allowed
  EXPECT_EQ(evaluator.evaluate(knots).status, Status::kInvalidPosture);
  EXPECT_NE(evaluator.trajectory().reason.str().find("speed limit: knots 5 and 6: q1_shoulder_yaw"),
            std::string::npos)
      << evaluator.trajectory().reason.c_str();
  EXPECT_THROW(evaluator.evaluate(knots.topRows(4)), std::invalid_argument);
  knots(0, 0) = std::nan("");
  EXPECT_THROW(evaluator.evaluate(knots), std::invalid_argument);
}

TEST(Trajectory, KnotsThatCollideAreReportedAndAvoided) {
  // At the lower limits of q2 and q3 the forearm is folded back onto the base.
  const Problem problem = load_problem("uvms/valve_trajectory");
  Eigen::VectorXd folded = problem.theta_r_default;
  folded[2] = problem.theta_r_min[2];
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, solver());
  const Trajectory& trajectory = evaluator.evaluate(constant_knots(problem, folded));
  EXPECT_NE(trajectory.status, Status::kInvalidPosture);
  EXPECT_NE(trajectory.collision.str().find("self-collision: knot 1: "), std::string::npos)
      << trajectory.collision.c_str();
  EXPECT_EQ(evaluator.evaluate_elastic(constant_knots(problem, folded), nullptr), -kInfinity);
  EXPECT_EQ(evaluator.trajectory().status, Status::kInvalidPosture);
  TrajectoryEvaluator blind(problem, Wrench::kPure, solver(), false);
  EXPECT_TRUE(blind.evaluate(constant_knots(problem, folded)).collision.empty());
}

TEST(Trajectory, SupportsNoSecondContact) {
  const Problem problem = load_problem("dual_arm/bar_wall");
  EXPECT_THROW(TrajectoryEvaluator(problem, Wrench::kPure, solver()), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
