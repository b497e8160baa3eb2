#include "lib/scenario/current_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/scenario/current_load.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Currents in any direction, but not along one axis of the world (3: along all), some with their
/// opposites.
LoadGroup random_currents(Random& random, int count, int still_axis) {
  LoadGroup cases(1);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d& current = cases.emplace_back().current;
    current = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (still_axis < 3) current[still_axis] = 0;
    if (i % 3 > 0) continue;
    const Eigen::Vector3d opposite = -current;
    cases.emplace_back().current = opposite;
  }
  return cases;
}

LoadGroup one_current(Random& random, bool beside_still_water) {
  LoadGroup cases(beside_still_water ? 2 : 1);
  cases.back().current = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  return cases;
}

/// Horizontal currents all around; an odd number has no opposites.
LoadGroup all_around(double speed, int count) {
  LoadGroup cases(1);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    cases.emplace_back().current = {speed * std::cos(angle), speed * std::sin(angle), 0};
  }
  return cases;
}

LoadGroup list_number(int i, Random& random) {
  switch (i % 8) {
    case 0:
      return one_current(random, false);
    case 1:
      return one_current(random, true);
    case 2:
      return all_around(0.3, 72);
    case 3:
      return all_around(1e-9, 25);
    default:
      return random_currents(random, 1 + 3 * i, i % 4);
  }
}

/// The inverse dynamics of a robot that moves through still water knows nothing of forms. No load
/// lies outside of the bounds.
void expect_inverse_dynamics(const Problem& problem) {
  Random random(5);
  PostureEvaluator evaluator(problem, false);
  CurrentLoad one(problem.robot);
  const int n = problem.robot.velocities();
  for (int i = 0; i < samples(80); ++i) {
    const Posture& posture = evaluator.evaluate(random_theta_r(problem, random));
    const LoadGroup cases = list_number(i, random);
    CurrentCases currents(problem.robot, cases);
    currents.set(posture);
    one.set(posture.base.R, posture.q);
    Eigen::VectorXd normal = random_numbers(random, n);
    if (i % 2 > 0) normal.head(6).setZero();  // as the normals of joints
    currents.aim(normal);
    Eigen::VectorXd along(static_cast<Eigen::Index>(cases.size()));
    double rounding = 0;
    for (std::size_t k = 0; k < cases.size(); ++k) {
      Eigen::VectorXd expected(n);
      one.evaluate(cases[k].current, expected);
      along[static_cast<Eigen::Index>(k)] = normal.dot(expected);
      const double size =
          expected.norm() + cases[k].current.squaredNorm();  // with the robot's mass
      rounding = std::max(rounding, 1e-12 * size * normal.norm());
      for (int axis = 0; axis < n; ++axis) {
        const double most = currents.most(Eigen::VectorXd::Unit(n, axis));
        EXPECT_LE(std::abs(expected[axis]), most + rounding);
      }
    }
    EXPECT_LE(along.cwiseAbs().maxCoeff(), currents.bound() + rounding);
    EXPECT_LE(along.cwiseAbs().maxCoeff(), currents.most(normal) + rounding);
    for (const double side : {-1.0, 1.0}) {
      int which = -1;
      const double worst = currents.worst(side, which);
      EXPECT_NEAR(worst, (side * along).maxCoeff(), rounding);
      ASSERT_TRUE(which >= 0 && which < along.size());
      EXPECT_NEAR(side * along[which], worst, rounding);
    }
  }
}

TEST(CurrentCases, AreTheInverseDynamics) { expect_inverse_dynamics(load_problem("uvms/valve")); }

/// The shipped task with other water: bodies have only some of drag and added mass.
Problem in_other_water(bool added_mass, bool linear, bool quadratic) {
  Problem problem = load_problem("uvms/valve");
  for (Link& link : problem.robot.links) {
    for (HydrodynamicBody& body : link.hydrodynamics) {
      if (!added_mass) body.added_mass.setZero();
      if (!linear) body.damping_linear.setZero();
      if (!quadratic) body.damping_quadratic.setZero();
    }
  }
  return problem;
}

TEST(CurrentCases, OfOneKindOfLoadAlone) {
  expect_inverse_dynamics(in_other_water(true, false, false));
  expect_inverse_dynamics(in_other_water(false, true, false));
  expect_inverse_dynamics(in_other_water(false, false, true));
}

/// Without water no direction is worse than another one.
TEST(CurrentCases, AreZeroWithoutLoads) {
  expect_inverse_dynamics(in_other_water(false, false, false));
}

/// Bodies that are turned in their links, with drag and added mass of each axis, on a prismatic
/// joint too.
TEST(CurrentCases, OfTurnedBodies) {
  Problem problem = load_problem("uvms/valve");
  problem.robot.joints[1].type = JointType::kPrismatic;
  Random random(6);
  for (Link& link : problem.robot.links) {
    HydrodynamicBody& body = link.hydrodynamics.emplace_back();
    body.frame = {random_rotation(random), {random.uniform(-1, 1), random.uniform(-1, 1), 0.3}};
    for (int axis = 0; axis < 6; ++axis) {
      body.added_mass[axis] = random.uniform(0, 5);
      body.damping_linear[axis] = random.uniform(0, 9);
      body.damping_quadratic[axis] = random.uniform(0, 9);
    }
  }
  expect_inverse_dynamics(problem);
}

/// Of cases that are equal the first one is the worst, and what was asked before changes no bit.
TEST(CurrentCases, DependOnTheirInputsOnly) {
  const Problem problem = load_problem("uvms/valve");
  Random random(7);
  PostureEvaluator evaluator(problem, false);
  LoadGroup cases = all_around(0.3, 72);
  const std::size_t once = cases.size();
  cases.insert(cases.end(), cases.begin(), cases.end());
  CurrentCases used(problem.robot, cases);
  for (int i = 0; i < samples(50); ++i) {
    const Posture& posture = evaluator.evaluate(random_theta_r(problem, random));
    const Eigen::VectorXd normal = random_numbers(random, problem.robot.velocities());
    CurrentCases fresh(problem.robot, cases);
    used.set(posture);
    fresh.set(posture);
    used.aim(normal);
    fresh.aim(normal);
    for (const double side : {1.0, -1.0}) {
      int own = -1, other = -1;
      EXPECT_EQ(used.worst(side, own), fresh.worst(side, other));
      EXPECT_EQ(own, other);
      EXPECT_LT(static_cast<std::size_t>(own), once);
    }
  }
}

/// A posture that is not a number has no worst current.
TEST(CurrentCases, OfNaNAreNaN) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator evaluator(problem, false);
  Posture posture = evaluator.evaluate(problem.theta_r_default);
  posture.base.R(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CurrentCases currents(problem.robot, all_around(0.3, 72));
  currents.set(posture);
  currents.aim(Eigen::VectorXd::Ones(problem.robot.velocities()));
  int which = -1;
  EXPECT_TRUE(std::isnan(currents.worst(1, which)));
}

}  // namespace
}  // namespace maxwrench
