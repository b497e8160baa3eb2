#include "lib/scenario/current_cases.h"

#include <gtest/gtest.h>

#include "lib/scenario/current_load.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Currents in any direction, still water among them.
LoadGroup random_currents(Random& random, int count) {
  LoadGroup cases(1);
  for (int i = 0; i < count; ++i) {
    cases.emplace_back().current = {random.uniform(-1, 1), random.uniform(-1, 1),
                                    random.uniform(-1, 1)};
  }
  return cases;
}

/// The inverse dynamics of a robot that moves through still water knows nothing of forms.
void expect_inverse_dynamics(const Problem& problem) {
  Random random(5);
  PostureEvaluator evaluator(problem, false);
  CurrentLoad one(problem.robot);
  Eigen::ArrayXXd tau;
  for (int i = 0; i < samples(50); ++i) {
    const Posture& posture = evaluator.evaluate(random_theta_r(problem, random));
    const LoadGroup cases = random_currents(random, 1 + i * 3);
    CurrentCases(problem.robot, cases).evaluate(posture, tau);
    ASSERT_EQ(tau.rows(), static_cast<Eigen::Index>(cases.size()));
    one.set(posture.base.R, posture.q);
    for (std::size_t k = 0; k < cases.size(); ++k) {
      Eigen::VectorXd expected(problem.robot.velocities());
      one.evaluate(cases[k].current, expected);
      const Eigen::VectorXd got = tau.row(static_cast<Eigen::Index>(k)).transpose();
      EXPECT_LT((got - expected).norm(), 1e-12 * (1 + expected.norm()));
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
