#include <gtest/gtest.h>

#include <cmath>

#include "tests/lib/measure/measure_evaluator.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Ellipsoid, IsThePositiveRoot) {
  // eq:transmissionUVMS along c: a beta^2 + 2 b beta + (g'g - 1) = 0 with a = |K J'c|^2, b = g'K
  // J'c, written out.
  Random random(8);
  for (int sample = 0; sample < 100; ++sample) {
    Problem problem = random_problem(random, 3);
    problem.robot.gravity = 0.5;
    MeasureEvaluator evaluate(problem, "ellipsoid", Wrench::kPure);
    const Capability& capability = evaluate(random_theta_r(problem, random));
    const Zonotope& set = problem.robot.actuation;
    const Eigen::VectorXd weight =
        set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs()).cwiseInverse();
    const Eigen::VectorXd column = weight.asDiagonal() * (set.B_pinv * evaluate.program().JtW);
    const Eigen::VectorXd offset = weight.asDiagonal() * (set.B_pinv * evaluate.program().tau_d);
    const double a = column.squaredNorm();
    const double b = column.dot(offset);
    const double discriminant = b * b - a * (offset.squaredNorm() - 1);
    if (offset.norm() >= 1) {
      EXPECT_EQ(capability.status, Status::kInfeasible);
      continue;
    }
    EXPECT_NEAR(capability.beta, (-b + std::sqrt(discriminant)) / a, 1e-9 * (1 + capability.beta));
  }
}

/// A weight that takes up all of the ellipsoid, up to rounding: no root of a negative number.
TEST(Ellipsoid, GivesNoNaNOnItsSurface) {
  Random random(9);
  int valued = 0;
  for (int sample = 0; sample < 200; ++sample) {
    Problem problem = random_problem(random, 3);
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const Zonotope& set = problem.robot.actuation;
    const Eigen::VectorXd weight =
        set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs()).cwiseInverse();
    MeasureEvaluator heavy(problem, "ellipsoid", Wrench::kPure);
    heavy(theta_r);
    problem.robot.gravity /= (weight.asDiagonal() * (set.B_pinv * heavy.program().tau_d)).norm();
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      MeasureEvaluator evaluate(problem, "ellipsoid", wrench);
      const Capability& capability = evaluate(theta_r);
      EXPECT_FALSE(std::isnan(capability.beta));
      if (capability.status != Status::kOptimal) continue;
      EXPECT_GE(capability.beta, -1e-6);
      ++valued;
    }
  }
  EXPECT_GT(valued, 0);
}

}  // namespace
}  // namespace maxwrench
