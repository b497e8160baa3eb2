#include "lib/scenario/current_cases.h"

#include <gtest/gtest.h>

#include "lib/scenario/current_load.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Currents in any direction, but not along one axis of the world; still water among them.
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

/// The inverse dynamics of a robot that moves through still water knows nothing of forms. No load
/// lies outside of the bounds.
void expect_inverse_dynamics(const Problem& problem) {
  Random random(5);
  PostureEvaluator evaluator(problem, false);
  CurrentLoad one(problem.robot);
  for (int i = 0; i < samples(50); ++i) {
    const Posture& posture = evaluator.evaluate(random_theta_r(problem, random));
    const LoadGroup cases = random_currents(random, 1 + i * 3, i % 4);
    CurrentCases currents(problem.robot, cases);
    currents.set(posture);
    one.set(posture.base.R, posture.q);
    const Eigen::VectorXd normal = random_numbers(random, problem.robot.velocities());
    currents.aim(normal);
    Eigen::VectorXd along(static_cast<Eigen::Index>(cases.size()));
    for (std::size_t k = 0; k < cases.size(); ++k) {
      Eigen::VectorXd expected(problem.robot.velocities());
      one.evaluate(cases[k].current, expected);
      along[static_cast<Eigen::Index>(k)] = normal.dot(expected);
      const double rounding = 1e-12 * (1 + expected.norm());
      EXPECT_LT((expected.cwiseAbs() - currents.most()).maxCoeff(), rounding);
    }
    const double rounding = 1e-12 * (1 + along.cwiseAbs().maxCoeff());
    EXPECT_LE(along.cwiseAbs().maxCoeff(), currents.bound() + rounding);
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

}  // namespace
}  // namespace maxwrench
