// Values of the measures of accelerations, against a planar arm in closed form, the equation of
// motion by the recursive algorithm, and dense least squares.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/math/decompositions.h"
#include "lib/robot/dynamics.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "tests/lib/measure/planar_arm.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// The largest beta up to which `holds`, which ends there, by bisection.
template <class Holds>
double last_of(const Holds& holds) {
  double low = 0, high = 1;
  while (holds(high)) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

TEST(DynamicMeasure, OfThePlanarArmInClosedForm) {
  PlanarArm arm(Eigen::Vector2d(-55, -40), Eigen::Vector2d(60, 30));
  Random random(21);
  for (int sample = 0; sample < 50; ++sample) {
    const double q_1 = random.uniform(-3, 3), q_2 = random.uniform(0.3, 2.8);
    const Posture posture = arm.posture(q_1, q_2);
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    const Eigen::Vector2d c(std::cos(angle), std::sin(angle));
    arm.problem.c << c[0], 0, c[1], 0, 0, 0;
    const Eigen::Vector2d smaller(55, 30);
    const auto in_ellipse = [&](double beta) {
      return arm.efforts(q_1, q_2, beta * c).cwiseQuotient(smaller).norm() <= 1;
    };
    const Capability along = value_at(arm.problem, kDynamicMeasures[0], posture);
    const Capability all = value_at(arm.problem, kDynamicMeasures[1], posture);
    if (!in_ellipse(0)) {
      EXPECT_EQ(along.status, Status::kInfeasible);
    } else {
      ASSERT_EQ(along.status, Status::kOptimal) << along.reason.c_str();
      const double expected = last_of(in_ellipse);
      EXPECT_NEAR(along.beta, expected, 1e-9 * expected);
      EXPECT_LT((along.u - arm.efforts(q_1, q_2, along.beta * c)).norm(), 1e-9);
    }
    double least = kInfinity;
    constexpr int kDirections = 20000;
    for (int i = 0; i < kDirections; ++i) {
      const double turn = 2 * std::numbers::pi * i / kDirections;
      const Eigen::Vector2d unit =
          arm.efforts(q_1, q_2, {std::cos(turn), std::sin(turn)}) - arm.load(q_1, q_2);
      for (int j = 0; j < 2; ++j) {
        const double limit = unit[j] > 0 ? arm.u_max[j] : arm.u_min[j];
        least = std::min(least, (limit - arm.load(q_1, q_2)[j]) / unit[j]);
      }
    }
    if (least < 0) {
      EXPECT_EQ(all.status, Status::kInfeasible);
      continue;
    }
    ASSERT_EQ(all.status, Status::kOptimal) << all.reason.c_str();
    // The nearest of the directions is at most half of their spacing off: a share of 1.3e-8.
    EXPECT_LE(all.beta, least * (1 + 1e-12));
    EXPECT_NEAR(all.beta, least, 2e-8 * least);
  }
}

/// A mass of 2 kg at the end of a level lever of 0.5 m with a motor of 20 N m: 20/(2 0.5) - 9.81
/// m/s^2 upwards, 20/(2 0.5) + 9.81 downwards. The first is possible in both directions.
TEST(DynamicMeasure, GravityHelpsDownwardsOnly) {
  Problem problem;
  problem.name = "lever";
  Robot& robot = problem.robot;
  robot.links.resize(2);
  robot.joints.resize(1);
  robot.joints[0].axis = -Eigen::Vector3d::UnitY();
  robot.links[1].mass = 2;
  robot.links[1].com.x() = 0.5;
  robot.end_effectors = {{"tool", 1, {Eigen::Matrix3d::Identity(), {0.5, 0, 0}}}};
  problem.W_any = Vector6d::Unit(2);
  Posture posture;
  posture.q = Vector::Zero(1);
  posture.J.setZero(6, 1);
  posture.J(2, 0) = 0.5;
  posture.J(4, 0) = -1;
  posture.tau_d = Vector::Constant(1, 9.81);
  for (const double sign : {1.0, -1.0}) {
    problem.c = sign * Vector6d::Unit(2);
    robot.actuation =
        make_zonotope(Matrix::Identity(1, 1), Vector::Constant(1, -20), Vector::Constant(1, 20));
    EXPECT_NEAR(value_at(problem, kDynamicMeasures[0], posture).beta, 20 - sign * 9.81, 1e-12);
    EXPECT_NEAR(value_at(problem, kDynamicMeasures[1], posture).beta, 20 - 9.81, 1e-12);
    // A motor that only lifts: the weight alone gives way downwards.
    robot.actuation =
        make_zonotope(Matrix::Identity(1, 1), Vector::Zero(1), Vector::Constant(1, 20));
    EXPECT_NEAR(value_at(problem, kDynamicMeasures[1], posture).beta, 9.81, 1e-12);
    EXPECT_THROW(make_dynamic_manipulability(problem), std::invalid_argument);
    robot.actuation =
        make_zonotope(Matrix::Identity(1, 1), Vector::Constant(1, -9), Vector::Constant(1, 9));
    for (const char* measure : kDynamicMeasures) {
      EXPECT_EQ(value_at(problem, measure, posture).status, Status::kInfeasible) << measure;
    }
  }
}

/// A vehicle with an arm, added mass and moments; c is a force or a torque.
Problem wet_problem(Random& random) {
  Problem problem = random_problem(random, 4);
  problem.robot.gravity = 1;
  for (Link& link : problem.robot.links) {
    link.inertia.diagonal().setConstant(random.uniform(0.01, 0.05));
    HydrodynamicBody water;
    water.frame = {random_rotation(random), random_vector(random, 0.1)};
    for (double& mass : water.added_mass) mass = random.uniform(0, 0.5);
    link.hydrodynamics = {water};
  }
  if (random.uniform(0, 1) < 0.5) {
    problem.c.tail<3>().setZero();
  } else {
    problem.c.head<3>().setZero();
  }
  problem.c.normalize();
  return problem;
}

/// The accelerations of the joints and the base under efforts, by the recursive algorithm.
Vector accelerations_of(const Problem& problem, const Posture& posture, const Vector& u) {
  Dynamics dynamics(problem.robot);
  dynamics.set_configuration(posture.base.R, posture.q);
  Vector v_dot(posture.J.cols());
  dynamics.forward(Vector::Zero(v_dot.size()), problem.robot.actuation.B * u, v_dot);
  return v_dot;
}

/// No efforts with |W_u u| <= 1 accelerate further than the supporting plane, whose normal p
/// follows from lambda: M lambda + J'p = 0, p'c = 1.
void expect_farthest(const Problem& problem, const Posture& posture, Random& random) {
  const Capability found = value_at(problem, kDynamicMeasures[0], posture);
  ASSERT_EQ(found.status, Status::kOptimal) << found.reason.c_str();
  EXPECT_TRUE(found.residual.within(1e-8 * (1 + found.beta)));
  const Zonotope& set = problem.robot.actuation;
  const Vector limits = set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs());
  EXPECT_NEAR(found.u.cwiseQuotient(limits).norm(), 1, 1e-10);
  const Vector a = posture.J * accelerations_of(problem, posture, found.u);
  EXPECT_LT((a - found.beta * problem.c).norm(), 1e-9 * (1 + found.beta));
  Dynamics dynamics(problem.robot);
  dynamics.set_configuration(posture.base.R, posture.q);
  Matrix M;
  dynamics.mass_matrix(M);
  const Vector p = -pseudo_inverse(posture.J.transpose()) * (M * found.lambda);
  EXPECT_NEAR(p.dot(problem.c), 1, 1e-9);
  double most = -kInfinity;
  for (int i = 0; i < 200; ++i) {
    Vector e = Vector::NullaryExpr(limits.size(), [&](Eigen::Index) { return random.normal(); });
    const Vector u = e.normalized().cwiseProduct(limits);
    most = std::max(most, p.dot(posture.J * accelerations_of(problem, posture, u)));
  }
  EXPECT_LE(most, found.beta * (1 + 1e-9));
  EXPECT_GT(most, 0);
}

TEST(DynamicMeasure, NoEffortsAccelerateFurtherAlongC) {
  Random random(22);
  int rank_deficient = 0;
  for (int sample = 0; sample < 40; ++sample) {
    Problem problem = wet_problem(random);
    if (sample % 4 == 0) {  // three thrusters and four motors for ten velocities
      problem.robot.thrusters.resize(3);
      problem.robot.gravity = 0;
      complete_actuation(problem.robot);
      ++rank_deficient;
      EXPECT_THROW(make_dynamic_capability(problem), std::invalid_argument);
    }
    PostureEvaluator model(problem, false);
    expect_farthest(problem, model.evaluate(random_theta_r(problem, random)), random);
  }
  EXPECT_EQ(rank_deficient, 10);
}

/// The accelerations of least kinetic energy, min v_dot'M v_dot with J v_dot = a, by their
/// equations as a whole, and the efforts of least squares.
TEST(DynamicMeasure, EveryDirectionIsWithinAllLimits) {
  Random random(23);
  for (int sample = 0; sample < 40; ++sample) {
    const Problem problem = wet_problem(random);
    PostureEvaluator model(problem, false);
    const Posture posture = model.evaluate(random_theta_r(problem, random));
    const Capability found = value_at(problem, kDynamicMeasures[1], posture);
    if (found.status == Status::kInfeasible) continue;
    ASSERT_EQ(found.status, Status::kOptimal) << found.reason.c_str();
    EXPECT_TRUE(found.residual.within(1e-8 * (1 + found.beta)));
    Dynamics dynamics(problem.robot);
    dynamics.set_configuration(posture.base.R, posture.q);
    Matrix M;
    dynamics.mass_matrix(M);
    const Eigen::Index n = M.rows();
    Matrix all = Matrix::Zero(n + 6, n + 6);
    all << M, posture.J.transpose(), posture.J, Matrix::Zero(6, 6);
    const Eigen::PartialPivLU<Matrix> equations(all);
    const Zonotope& set = problem.robot.actuation;
    const bool linear = problem.c.tail<3>().isZero();
    const auto excess = [&](const Eigen::Vector3d& direction) {
      Vector right = Vector::Zero(n + 6);
      right.segment<3>(n + (linear ? 0 : 3)) = found.beta * direction;
      const Vector v_dot = equations.solve(right).head(n);
      const Vector u = set.B_pinv * (M * v_dot + posture.tau_d);
      return std::max((u - set.u_max).maxCoeff(), (set.u_min - u).maxCoeff());
    };
    double most = -kInfinity;
    for (int i = 0; i < 500; ++i) {
      most = std::max(most, excess(random_vector(random).normalized()));
    }
    EXPECT_LE(most, 1e-9);
    const Vector a = posture.J * accelerations_of(problem, posture, found.u);
    EXPECT_NEAR(a.norm(), found.beta, 1e-9 * (1 + found.beta));
    const Eigen::Vector3d worst = linear ? a.head<3>() : a.tail<3>();
    EXPECT_NEAR(worst.norm(), found.beta, 1e-9 * (1 + found.beta));
    EXPECT_NEAR(excess(worst.normalized()), 0, 1e-8);
  }
}

}  // namespace
}  // namespace maxwrench
