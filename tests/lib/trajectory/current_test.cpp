// Tasks in time in a steady current.

#include <gtest/gtest.h>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "tests/support/knot_gradients.h"
#include "tests/support/scenario_task.h"
#include "tests/support/support.h"
#include "tests/support/task_in_time.h"
#include "tests/support/trajectory_proofs.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

constexpr const char* kFlow = "[environment]\ncurrent = [0.3, -0.2, 0.1]\n";
const Eigen::Vector3d kFlowVelocity(0.3, -0.2, 0.1);

Problem turn_in_flow() { return task_in_time("valve_trajectory", "", kFlow); }

Path drift(const Problem& problem, const Eigen::Vector3d& displacement, double angle) {
  return Path::screw(problem.pose, Eigen::Vector3d(1, -2, 3).normalized(), problem.pose.p, angle,
                     displacement, Timing::kLinear, problem.motion->T);
}

Trajectory held_in_flow(const Eigen::VectorXd& theta_r, const Problem& problem) {
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make, false);
  evaluator.evaluate(constant_knots(problem, theta_r));
  evaluator.evaluate_between_knots();
  return evaluator.trajectory();
}

/// A robot that rests has the loads of the static task.
TEST(CurrentInTime, AtRestIsTheStaticTask) {
  Problem problem = turn_in_flow();
  EXPECT_TRUE(problem.scenarios.empty());
  problem.motion->path = Path::constant(problem.pose, problem.motion->T);
  const Problem at_rest = scenario_task(kTurn, kFlow);
  const double beta = evaluate(at_rest, at_rest.theta_r_default).beta();
  EXPECT_NE(beta, evaluate(load_problem("uvms/valve"), at_rest.theta_r_default).beta());
  const Trajectory resting = held_in_flow(at_rest.theta_r_default, problem);
  EXPECT_NEAR(resting.value, beta, 1e-8);
  EXPECT_NEAR(resting.value_between_knots, beta, 1e-8);
  EXPECT_TRUE(resting.solution.residual.within(1e-8));
}

/// A robot that the water carries along rests in the water: 9.00 N m, the value in still water.
TEST(CurrentInTime, CarriedAlongIsStillWater) {
  Problem problem = turn_in_flow();
  problem.motion->path = drift(problem, problem.motion->T * kFlowVelocity, 0);
  const Problem still = load_problem("uvms/valve");
  EXPECT_NEAR(held_in_flow(still.theta_r_default, problem).value, 9, 1e-8);
}

/// Galilei: a path in still water, seen from axes that move at -v_c, is a path with a further
/// displacement v_c T in the current v_c. All loads are the same, whatever theta_r does.
TEST(CurrentInTime, LoadsAreThoseInAxesThatMoveWithTheWater) {
  Problem still = load_problem("uvms/valve_trajectory"), flowing = turn_in_flow();
  const Eigen::Vector3d displacement(0.4, -0.3, 0.2);
  still.motion->path = drift(still, displacement, 1.1);
  flowing.motion->path = drift(flowing, displacement + still.motion->T * kFlowVelocity, 1.1);
  Random random(4);
  Eigen::MatrixXd knots = constant_knots(still, still.theta_r_default);
  for (double& entry : knots.reshaped()) entry += 0.2 * random.normal();
  MotionEvaluator here(still, make_scheme(*still.motion)),
      there(flowing, make_scheme(*flowing.motion));
  std::vector<Instant> expected, found;
  here.evaluate(all_knots(*still.motion, knots), expected);
  there.evaluate(all_knots(*flowing.motion, knots), found);
  ASSERT_EQ(found.size(), expected.size());
  double most = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i].tau_d - expected[i].tau_d).lpNorm<Eigen::Infinity>(), 1e-10);
    most = std::max(most, (found[i].v - expected[i].v).norm());
  }
  EXPECT_GT(most, 0.3);  // the motions differ
}

TEST(CurrentInTime, GradientIsThatOfDifferences) {
  Random random(2);
  for (const Scheme scheme : {Scheme::kSpline, Scheme::kEnds}) {
    Problem problem = turn_in_flow();
    problem.motion->scheme = scheme;
    problem.motion->k = 4;
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, trajectory_solvers().front().make, false);
    const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
    expect_knot_gradient(evaluator, moved_a_little(knots, random), 1e-5);
  }
}

/// A proof holds in its current only.
TEST(CurrentInTime, IsProvenAndVerified) {
  const Problem problem = turn_in_flow();
  const Trajectory planned = held_in_flow(problem.theta_r_default, problem);
  const TrajectoryCertificate proof =
      certified(problem, constant_knots(problem, problem.theta_r_default));
  EXPECT_LE(proof.value, planned.value_between_knots + 1e-9);
  EXPECT_GE(proof.value, planned.value_between_knots * (1 - 1e-3));
  EXPECT_EQ(verify(problem, proof, 1).rejection, "");
  EXPECT_NE(verify(load_problem("uvms/valve_trajectory"), proof, 1).rejection, "");
  TrajectoryCertificate wrong = proof;
  wrong.value = planned.value_between_knots * 1.01;
  EXPECT_NE(verify(problem, wrong, 1).rejection, "");
}

}  // namespace
}  // namespace maxwrench
