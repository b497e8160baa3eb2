#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/math/random.h"
#include "lib/trajectory/overshoot.h"
#include "lib/trajectory/scheme.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/knot_gradients.h"
#include "tests/support/support.h"

// A payload from one posture to another.

namespace maxwrench {
namespace {

TrajectorySolverMaker transfer_solver() { return make_facets_or_ipm; }

/// 3.79329 kg on the straight line is the value of an independent model.
TEST(Transfer, OnTheStraightLineIsThatOfAnIndependentModel) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  EXPECT_STREQ(problem.type(), "transfer");
  EXPECT_STREQ(problem.unit(), "kg");
  EXPECT_EQ(knots_of(problem), 6);
  for (const auto& make :
       {transfer_solver(), TrajectorySolverMaker([] { return make_trajectory_ipm(); })}) {
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, make);
    const Trajectory& trajectory = evaluator.evaluate(default_knots(problem));
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    EXPECT_NEAR(trajectory.value, 3.79329, 5e-6);
    EXPECT_TRUE(trajectory.solution.residual.within(1e-7));
    EXPECT_EQ(trajectory.instants.size(), 29u);
    EXPECT_EQ(trajectory.gradient.rows(), 6);
  }
}

/// Both ends are given, and the robot rests there, though not without acceleration.
TEST(Transfer, BeginsAndEndsAtRestAtItsEnds) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, transfer_solver());
  const std::vector<Instant>& instants = evaluator.evaluate(default_knots(problem)).instants;
  EXPECT_LT((instants.front().q - problem.motion->theta_0).norm(), 1e-12);
  EXPECT_LT((instants.back().q - problem.motion->theta_T).norm(), 1e-12);
  for (const Instant* end : {&instants.front(), &instants.back()}) {
    EXPECT_LT(end->v.norm(), 1e-12);
    EXPECT_GT(end->v_dot.norm(), 1);
  }
}

/// The efforts of both joints by hand: Newton's law for the middle of each link and for the tip.
Eigen::Vector2d efforts_by_hand(const Instant& instant, double mass) {
  constexpr double kLength = 0.5, kMass = 2, kInertia = kMass * kLength * kLength / 12;
  const double angle[] = {instant.q[0], instant.q[0] + instant.q[1]};
  const double rate[] = {instant.v[0], instant.v[0] + instant.v[1]};
  const double bend[] = {instant.v_dot[0], instant.v_dot[0] + instant.v_dot[1]};
  const auto along = [&](int i) { return Eigen::Vector2d(std::cos(angle[i]), std::sin(angle[i])); };
  const auto across = [&](int i) {
    return Eigen::Vector2d(-std::sin(angle[i]), std::cos(angle[i]));
  };
  const auto acceleration = [&](int i, double at) -> Eigen::Vector2d {
    return at * (bend[i] * across(i) - rate[i] * rate[i] * along(i));
  };
  const Eigen::Vector2d up(0, 9.81), elbow = acceleration(0, kLength);
  const auto moment = [](const Eigen::Vector2d& r, const Eigen::Vector2d& f) {
    return r[0] * f[1] - r[1] * f[0];
  };
  const Eigen::Vector2d upper = kMass * (acceleration(0, kLength / 2) + up);
  const Eigen::Vector2d lower = kMass * (elbow + acceleration(1, kLength / 2) + up);
  const Eigen::Vector2d tip = mass * (elbow + acceleration(1, kLength) + up);
  const Eigen::Vector2d a = kLength * along(0), b = kLength * along(1);
  return {moment(a / 2, upper) + moment(a + b / 2, lower) + moment(a + b, tip) +
              kInertia * (bend[0] + bend[1]),
          moment(b / 2, lower) + moment(b, tip) + kInertia * bend[1]};
}

TEST(Transfer, HasTheEffortsOfNewtonsLaw) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, transfer_solver());
  Random random(1);
  const Trajectory& trajectory = evaluator.evaluate(moved_a_little(default_knots(problem), random));
  ASSERT_EQ(trajectory.status, Status::kOptimal);
  for (const Instant& instant : trajectory.instants) {
    EXPECT_LT((instant.u - efforts_by_hand(instant, trajectory.value)).norm(), 1e-9);
    EXPECT_EQ(instant.beta(), trajectory.value);
  }
}

/// The wrench of 1 kg depends on the motion, so the gradient has its derivatives.
TEST(Transfer, HasExactGradients) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, transfer_solver());
  Random random(2);
  expect_knot_gradient(evaluator, moved_a_little(default_knots(problem), random), 1e-6);
}

/// The columns of the knots in the linear program of a search are those of the gradient.
TEST(Transfer, IsLinearisedAsItsGradientSays) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, transfer_solver());
  Eigen::MatrixXd gradient;
  evaluator.evaluate_elastic(default_knots(problem), &gradient);
  const TrajectoryProgram& program = evaluator.linearize();
  const TrajectorySolution& solution = evaluator.elastic_solution();
  Eigen::VectorXd pulled = Eigen::VectorXd::Zero(gradient.size());
  for (int i = 0; i < program.size(); ++i) {
    pulled -= program.G[static_cast<std::size_t>(i)].transpose() * solution.lambda.col(i);
  }
  EXPECT_LT((pulled - stacked(gradient)).norm(), 1e-9 * (1 + pulled.norm()));
}

/// Between the instants the efforts may exceed their limits by what `overshoot` says: the largest
/// share at 100 instants per interval, here from the table evaluated at as many instants.
TEST(Transfer, ReportsTheOvershootBetweenInstants) {
  Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, transfer_solver());
  const Eigen::MatrixXd knots = default_knots(problem);
  evaluator.evaluate(knots);
  evaluator.evaluate_between_knots();
  const double mass = evaluator.trajectory().value;
  problem.motion->instants_per_interval = 100;
  TrajectoryEvaluator fine(problem, Wrench::kPure, transfer_solver());
  double share = 0;
  for (const Instant& instant : fine.evaluate(knots).instants) {
    const Eigen::Vector2d u = efforts_by_hand(instant, mass).cwiseAbs();
    share = std::max({share, u[0] / 60, u[1] / 25});
  }
  EXPECT_NEAR(evaluator.trajectory().overshoot, share - 1, 1e-9);
  EXPECT_GT(share, 1);
}

TEST(Transfer, ThatIsTooFastOrBeyondALimitIsInvalid) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, transfer_solver());
  Eigen::MatrixXd knots = default_knots(problem);
  knots(2, 1) = 1.5;
  const Trajectory& fast = evaluator.evaluate(knots);
  EXPECT_EQ(fast.status, Status::kInvalidPosture);
  EXPECT_EQ(fast.reason.str().find("speed limit: knots 3 and 4: q2"), 0u) << fast.reason.c_str();
  knots(2, 1) = 3.1;
  const Trajectory& far = evaluator.evaluate(knots);
  EXPECT_NE(far.reason.str().find("joint limit: knot 4: q2"), std::string::npos)
      << far.reason.c_str();
  EXPECT_THROW(evaluator.evaluate(Eigen::MatrixXd::Zero(8, 2)), std::invalid_argument);
}

/// The extremes of the cubics, against a fine sample of the spline. The limits are tightened so
/// that they are exceeded.
TEST(Transfer, TellsHowFarJointsExceedTheirLimits) {
  Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml");
  Random random(5);
  Eigen::MatrixXd Q = all_knots(*problem.motion, default_knots(problem));
  for (Eigen::Index i = 1; i + 1 < Q.rows(); ++i) {
    for (Eigen::Index j = 0; j < Q.cols(); ++j) Q(i, j) += random.uniform(-0.3, 0.3);
  }
  const JointOvershoot found = joint_overshoot_of(problem, Q, problem.motion->T);
  const SchemeMaps maps = make_dense_spline(*problem.motion, 2000);
  double speed = -1, place = -kInfinity;
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    const double fastest = problem.robot.joints[static_cast<std::size_t>(j)].velocity_max;
    speed = std::max(speed, (maps.V * Q.col(j)).lpNorm<Eigen::Infinity>() / fastest - 1);
    const Eigen::VectorXd places = maps.P * Q.col(j);
    place = std::max({place, places.maxCoeff() - problem.theta_r_max[j],
                      problem.theta_r_min[j] - places.minCoeff()});
  }
  EXPECT_GE(found.speed, speed - 1e-12);
  EXPECT_NEAR(found.speed, speed, 1e-6);
  EXPECT_GE(found.place, place - 1e-12);
  EXPECT_NEAR(found.place, place, 1e-6);
}

}  // namespace
}  // namespace maxwrench
