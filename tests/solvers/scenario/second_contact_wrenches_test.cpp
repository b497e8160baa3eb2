#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "tests/solvers/scenario/gradients.h"
#include "tests/solvers/scenario/ordinary_tasks.h"
#include "tests/support/contacts.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

/// The weight of a payload and uncertain loads do not turn with a pose that is partly free.
TEST(SecondContactScenarios, GradientsAtAPartlyFreePoseAreThoseOfDifferences) {
  const Problem task = second_contact_task(
      kTwoArms, "",
      "[payload]\ncom = [0.05, 0.03, 0.02]\n[pose.range]\nx = [-0.05, 0.05]\nroll = [-0.4, 0.4]\n"
      "pitch = [-0.4, 0.4]\n[uncertainty]\nmass.right_link_4 = 0.1\ntrim = 0.2\n"
      "[loss]\ncases = [['front_left_vertical']]\n");
  Options options;
  options.check_collision = false;
  Random random(6);
  expect_gradients(task, options, random);
}

/// With any wrenches the free components of each scenario are those of an ordinary task.
TEST(SecondContactScenarios, OfAnyWrenchesAreOrdinaryTasks) {
  const Problem task =
      second_contact_task(kTwoArms, kTurn, "[loss]\nany = 1\nactuators = ['thrusters']\n");
  const std::vector<OrdinaryTask> ordinary = any_dead(second_contact_task(kTwoArms, kTurn, ""));
  Options options;
  options.wrench = Wrench::kAny;
  options.check_collision = false;
  Random random(9);
  for (int i = 0; i < samples(6); ++i) {
    const Answer answer = evaluate(task, near_default(task, random), options);
    if (answer.posture.status != Status::kValid) continue;
    double high = kInfinity;
    for (const OrdinaryTask& one : ordinary) {
      high = std::min(high, value_at(one.task, answer.posture, Wrench::kAny));
    }
    ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.str();
    EXPECT_NEAR(answer.beta(), high, 1e-8 * (1 + high));
  }
}

/// A disc has the value of its weakest direction, which the answer names.
TEST(SecondContactScenarios, DiscIsItsWeakestDirection) {
  const Problem task =
      second_contact_task(kBarAndWall, "ball = { axes = ['fx', 'fy'], radius = 2 }", "");
  const Problem plain = second_contact_task(kBarAndWall, kTurn, "");
  const Answer answer = evaluate(task, task.theta_r_default);
  ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.str();
  const auto value_along = [&](const Vector6d& c) {
    return value_at(along_c(plain, c), answer.posture, Wrench::kPure) / 2;
  };
  const double beta = answer.beta();
  EXPECT_NEAR(value_along(answer.capability.decides.c), beta, 1e-8 * beta);
  for (int k = 0; k < 360; ++k) {
    const double angle = 2 * std::numbers::pi * k / 360;
    Vector6d c = Vector6d::Zero();
    c.head<2>() << std::cos(angle), std::sin(angle);
    EXPECT_GE(value_along(c), beta * (1 - 1e-9));
  }
}

/// A ball of three axes needs facets.
TEST(SecondContactScenarios, BallOfThreeAxesIsRejected) {
  const Problem task =
      second_contact_task(kBarAndWall, "ball = { axes = ['fx', 'fy', 'fz'], radius = 2 }", "");
  try {
    evaluate(task, task.theta_r_default);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find("wrench: got a ball, expected pure wrenches of one"),
              0u)
        << error.what();
  }
}

/// A drawn model lies between the corners, so none is below the guarantee.
TEST(SecondContactScenarios, SampleIsNotBelowTheGuarantee) {
  const Problem task = second_contact_task(kTwoArms, kTurn, kUncertain);
  const Answer answer = evaluate(task, task.theta_r_default);
  ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.str();
  const ScenarioSample sample = sample_scenarios(answer, samples(500), 1, std::nullopt);
  EXPECT_EQ(sample.below, 0);
  EXPECT_EQ(sample.infeasible, 0);
  EXPECT_GT(sample.median, answer.beta());
}

}  // namespace
}  // namespace maxwrench
