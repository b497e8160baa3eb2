#include "verify/gain.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/contacts.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The library's singular values are those of another Jacobian, in world axes.
TEST(ContactGain, IsTheLibrarysSmallestGain) {
  Random random(5);
  for (const char* name : kContactProblems) {
    const Problem problem = load_problem(name);
    PostureEvaluator model(problem, false);
    for (int sample = 0; sample < 20; ++sample) {
      const Posture& posture = model.evaluate(random_theta_r(problem, random));
      EXPECT_NEAR(contact_gain(problem, posture.links),
                  smallest_gain(problem.robot, *problem.contact, posture.J, posture.J_2), 1e-9)
          << name;
    }
  }
}

TEST(ContactGain, OfAContactThatFixesNothingIsZero) {
  Problem problem = load_problem("dual_arm/bar_wall");
  PostureEvaluator model(problem, false);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  EXPECT_GT(contact_gain(problem, posture.links), 0);
  problem.contact->rank = 0;
  EXPECT_EQ(contact_gain(problem, posture.links), 0);
}

}  // namespace
}  // namespace maxwrench
