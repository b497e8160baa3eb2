#include "lib/trajectory/carried.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/random.h"
#include "lib/robot/dynamics.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/knot_gradients.h"
#include "tests/support/support.h"

// A payload along a path, and a table of wrenches.

namespace maxwrench {
namespace {

Eigen::Vector3d any_vector(Random& random, double size) {
  return size * Eigen::Vector3d::NullaryExpr([&] { return random.normal(); });
}

CarriedBody any_body(Random& random) {
  CarriedBody body;
  body.com = any_vector(random, 0.1);
  const Eigen::Matrix3d A = 0.1 * Eigen::Matrix3d::NullaryExpr([&] { return random.normal(); });
  body.inertia = A * A.transpose() + 0.01 * Eigen::Matrix3d::Identity();
  body.volume = random.uniform(0, 5e-4);
  body.cob = any_vector(random, 0.1);
  for (double& entry : body.added_mass) entry = random.uniform(0, 0.5);
  return body;
}

/// The robot with 1 kg of a body as another part of the link that carries the end effector: masses
/// add up, and inertias about the common centre of mass by Steiner's theorem.
Robot loaded(Robot robot, const EndEffector& tool, const CarriedBody& body) {
  Link& link = robot.links[static_cast<std::size_t>(tool.link)];
  const Pose<double>& at = tool.placement;
  const Eigen::Vector3d com = at.R * body.com + at.p;
  const double mass = link.mass + 1;
  const Eigen::Vector3d centre = (link.mass * link.com + com) / mass;
  const auto steiner = [&](double m, const Eigen::Vector3d& p) -> Eigen::Matrix3d {
    const Eigen::Vector3d d = p - centre;
    return m * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  };
  link.inertia +=
      steiner(link.mass, link.com) + steiner(1, com) + at.R * body.inertia * at.R.transpose();
  link.com = centre;
  link.mass = mass;
  const double volume = link.volume + body.volume;
  if (volume > 0) {
    link.cob = (link.volume * link.cob + body.volume * (at.R * body.cob + at.p)) / volume;
  }
  link.volume = volume;
  HydrodynamicBody moved;
  moved.frame = {at.R, com};
  moved.added_mass = body.added_mass;
  link.hydrodynamics.push_back(moved);
  return robot;
}

/// Inverse dynamics is affine in the mass: the load of 1 kg is the difference of two calls.
TEST(CarriedBody, IsWhatMakesTheInverseDynamicsHeavier) {
  Problem problem = load_problem("uvms/lift");
  problem.motion.emplace();
  problem.motion->k = 4;
  problem.motion->T = 2;
  Random random(1);
  const EndEffector& tool = problem.robot.end_effectors[0];
  for (int sample = 0; sample < 10; ++sample) {
    const CarriedBody body = any_body(random);
    problem.motion->payload = body;
    problem.motion->path =
        Path::screw(problem.pose, any_vector(random, 1).normalized(), any_vector(random, 0.5), 1.5,
                    any_vector(random, 1), Timing::kCubic, 2);
    Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
    for (double& entry : knots.reshaped()) entry += 0.05 * random.normal();
    if (sample % 2 == 1) problem.robot.current = any_vector(random, 0.3);
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, [] { return make_trajectory_ipm(); });
    const Robot heavier = loaded(problem.robot, tool, body);
    Dynamics dynamics(heavier);
    evaluator.evaluate(knots);
    for (const Instant& instant : evaluator.trajectory().instants) {
      Eigen::VectorXd tau;
      dynamics.set_configuration(instant.base.R, instant.q);
      dynamics.inverse(instant.v, instant.v_dot, tau);
      const Eigen::VectorXd added = instant.J.transpose() * instant.c;
      EXPECT_LT((tau - instant.tau_d - added).lpNorm<Eigen::Infinity>(), 1e-11 * (1 + tau.norm()));
    }
  }
}

/// A payload of steel: r = (0.05, 0, 0), carried along [0.6, 0, 0.4] m in 3 s.
Problem carried_steel() {
  Problem problem = load_problem("uvms/lift");
  MotionTask& motion = problem.motion.emplace();
  motion.path = Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), problem.pose.p, 0,
                            {0.6, 0, 0.4}, Timing::kCubic, 3);
  motion.T = 3;
  motion.k = 8;
  CarriedBody& body = motion.payload.emplace();
  body.com = body.cob = {0.05, 0, 0};
  body.inertia = 0.002 * Eigen::Matrix3d::Identity();
  body.volume = 1.0 / 7850;
  body.added_mass.head<3>().setConstant(0.5 * 998 / 7850);
  return problem;
}

/// 2.925898 kg is the value of an independent model of the same robot.
TEST(CarriedBody, AlongAPathIsThatOfAnIndependentModel) {
  const Problem problem = carried_steel();
  EXPECT_STREQ(problem.unit(), "kg");
  for (const auto& make : {make_facets_or_ipm, +[] { return make_trajectory_ipm(); }}) {
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, make);
    const Trajectory& trajectory =
        evaluator.evaluate(constant_knots(problem, problem.theta_r_default));
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    EXPECT_NEAR(trajectory.value, 2.925898, 1e-6);
    EXPECT_TRUE(trajectory.solution.residual.within(1e-7));
    for (const Instant& instant : trajectory.instants) {
      EXPECT_NEAR(instant.beta(), trajectory.value, 1e-7);
      EXPECT_LT((instant.h - trajectory.value * instant.c).norm(), 1e-6);
    }
    evaluator.evaluate_between_knots();
    EXPECT_NEAR(trajectory.value_between_knots, trajectory.value, 1e-6);
  }
}

/// Without motion it is what the robot holds at rest: the value of an independent model for
/// r = (0.05, 0, 0.02).
TEST(CarriedBody, AtRestIsTheStaticPayload) {
  Problem problem = carried_steel();
  MotionTask& motion = *problem.motion;
  motion.path = Path::constant(problem.pose, motion.T);
  motion.payload->com = motion.payload->cob = {0.05, 0, 0.02};
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, make_facets_or_ipm);
  const Trajectory& trajectory =
      evaluator.evaluate(constant_knots(problem, problem.theta_r_default));
  EXPECT_NEAR(trajectory.value, 3.010312, 1e-6);
  const Vector6d c = trajectory.instants[0].c;
  EXPECT_NEAR(c[2], 8.562818, 1e-6);
  EXPECT_NEAR(c[4], -0.428141, 1e-6);
}

void expect_exact_gradient(const Problem& problem, Random& random) {
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, make_facets_or_ipm, false);
  expect_knot_gradient(evaluator, moved_a_little(default_knots(problem), random), 1e-6);
}

TEST(CarriedBody, HasExactGradients) {
  Random random(2);
  expect_exact_gradient(carried_steel(), random);
}

Problem with_table(const std::vector<double>& times, const Matrix6Xd& wrenches) {
  Problem problem = carried_steel();
  problem.motion->payload.reset();
  problem.motion->table = WrenchTable{"", times, wrenches};
  return problem;
}

TEST(WrenchTable, IsLinearInBetween) {
  WrenchTable table{"", {0, 1, 3}, Matrix6Xd::Zero(6, 3)};
  table.wrenches.row(0) << 2, 4, -4;
  EXPECT_EQ(table.at(-1)[0], 2);
  EXPECT_EQ(table.at(0)[0], 2);
  EXPECT_EQ(table.at(0.25)[0], 2.5);
  EXPECT_EQ(table.at(1)[0], 4);
  EXPECT_EQ(table.at(2)[0], 0);
  EXPECT_EQ(table.at(3)[0], -4);
  EXPECT_EQ(table.at(7)[0], -4);
}

/// A constant wrench of 4 N along z: its factor is a quarter of the least force along z of any
/// instant, as no instant limits it from below.
TEST(WrenchTable, ThatIsConstantHasTheValueOfItsDirection) {
  Matrix6Xd wrenches = Matrix6Xd::Zero(6, 2);
  wrenches.row(2).setConstant(4);
  const Problem problem = with_table({0, 3}, wrenches);
  EXPECT_STREQ(problem.unit(), "-");
  Problem lift = problem;
  lift.motion->table.reset();
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  TrajectoryEvaluator factor(problem, Wrench::kPure, make_facets_or_ipm);
  TrajectoryEvaluator force(lift, Wrench::kPure, make_facets_or_ipm);
  EXPECT_NEAR(4 * factor.evaluate(knots).value, force.evaluate(knots).value, 1e-8);
}

/// The wrenches of the payload at the instants, as a table, give its mass again. Between them the
/// table is linear and the payload is not; so only the value at the instants is the same.
TEST(WrenchTable, OfAPayloadHasItsMass) {
  const Problem steel = carried_steel();
  const Eigen::MatrixXd knots = constant_knots(steel, steel.theta_r_default);
  TrajectoryEvaluator carried(steel, Wrench::kPure, make_facets_or_ipm);
  const Trajectory& trajectory = carried.evaluate(knots);
  std::vector<double> times;
  Matrix6Xd wrenches(6, static_cast<Eigen::Index>(trajectory.instants.size()));
  for (const Instant& instant : trajectory.instants) {
    wrenches.col(static_cast<Eigen::Index>(times.size())) = instant.c;
    times.push_back(instant.t);
  }
  const Problem problem = with_table(times, wrenches);
  TrajectoryEvaluator table(problem, Wrench::kPure, make_facets_or_ipm);
  EXPECT_NEAR(table.evaluate(knots).value, trajectory.value, 1e-9);
  Random random(3);
  expect_exact_gradient(problem, random);
}

/// A table in the axes of the end effector turns with it.
TEST(WrenchTable, TurnsWithTheEndEffector) {
  Matrix6Xd wrenches = Matrix6Xd::Zero(6, 2);
  wrenches.row(0).setConstant(1);
  Problem problem = with_table({0, 3}, wrenches);
  problem.motion->path = Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), problem.pose.p,
                                     M_PI / 2, Eigen::Vector3d::Zero(), Timing::kCubic, 3);
  const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  for (const bool turns : {false, true}) {
    problem.motion->c_turns = turns;
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, make_facets_or_ipm);
    const Vector6d c = evaluator.evaluate(knots).instants.back().c;
    EXPECT_LT((c - Vector6d::Unit(turns ? 1 : 0)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace maxwrench
