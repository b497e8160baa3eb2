#include "solvers/certify/box_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maxwrench/load.h"
#include "tests/support/loops.h"

namespace maxwrench {
namespace {

class BoxCoordinatesOf : public testing::TestWithParam<const char*> {};

/// The equations of dependent coordinates are zero at the coordinates of any posture, and a turn of
/// any angle changes nothing.
TEST_P(BoxCoordinatesOf, SatisfyTheEquations) {
  const Problem problem = loop_problem(GetParam());
  const BoxCoordinates coordinates(problem);
  const LoopCoordinates all(problem, ContactForces::kOfBase);
  ASSERT_EQ(coordinates.count(), all.lower.size());
  PostureEvaluator model(problem, false);
  Random random(4);
  int found = 0;
  for (int i = 0; i < 200 && found < 20; ++i) {
    if (model.evaluate(random_theta_r(problem, random)).status != Status::kValid) continue;
    ++found;
    const Posture& posture = model.select(model.ik_solutions() - 1);
    Eigen::VectorXd x = coordinates.of(posture);
    EXPECT_EQ(x.head(problem.redundancy()), posture.theta_r);
    const Eigen::VectorXd expected = loop_coordinates(problem, all, posture, {}, 0);
    EXPECT_LE((coordinates.within_a_turn(x) - expected).lpNorm<Eigen::Infinity>(), 1e-12);
    for (int k = 0; k < coordinates.count(); ++k) {
      if (coordinates.unit(k) != std::string("rad")) continue;
      x[k] += (k % 2 == 0 ? 2 : -4) * std::numbers::pi;
    }
    EXPECT_LE((coordinates.within_a_turn(x) - expected).lpNorm<Eigen::Infinity>(), 1e-12);
  }
  EXPECT_GE(found, 5);
}

INSTANTIATE_TEST_SUITE_P(Tasks, BoxCoordinatesOf,
                         testing::Values("fixed/push", "mobile/push", "mobile/push_any_height",
                                         "random, yaw", "random, x y z yaw", "random, free tool",
                                         "dual_arm/bar_alone"),
                         loop_name);

TEST(BoxCoordinates, HaveNamesUnitsAndTurns) {
  const Problem problem = loop_problem("mobile/push");
  const BoxCoordinates coordinates(problem);
  ASSERT_EQ(coordinates.count(), 6);  // two redundant joints, three dependent ones, the yaw
  EXPECT_EQ(coordinates.name(0), problem.theta_r_name(0));
  const auto first = static_cast<std::size_t>(problem.dependent.front());
  EXPECT_EQ(coordinates.name(2), problem.robot.joints[first].name);
  EXPECT_EQ(coordinates.name(5), "yaw");
  EXPECT_STREQ(coordinates.unit(5), "rad");
  EXPECT_NE(coordinates.turns()[5], 0);
  for (int i = 0; i < 5; ++i) {
    const double range = coordinates.upper(i) - coordinates.lower(i);
    EXPECT_EQ(coordinates.turns()[static_cast<std::size_t>(i)] != 0,
              std::abs(range - 2 * std::numbers::pi) < 1e-9);
  }
}

}  // namespace
}  // namespace maxwrench
