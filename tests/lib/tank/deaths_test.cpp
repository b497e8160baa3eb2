#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "maxwrench/load.h"
#include "maxwrench/scenario.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/tank_scenarios.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

constexpr const char* kDyingThruster = "front_left_vertical";

/// The wrench `planned` along c, at the default posture of uvms/lift, with a dying thruster.
TankRun lift_with_a_death(double planned, double t, double noticed_after = 0) {
  const Problem problem = load_problem("uvms/lift");
  const Answer answer = evaluate(problem, problem.theta_r_default);
  TankOptions options;
  options.hold = 10;
  options.until_hold = true;
  options.deaths = {death_of(problem.robot, "dies", kDyingThruster, t)};
  options.noticed_after = noticed_after;
  return simulate_posture(answer, planned, "cvode", options);
}

/// By an independent model the lift's default posture holds 14.55665 N whichever thruster is dead,
/// and 29.92061 N with all of them: what survives is held, what does not is lost.
TEST(TankDeath, WhatSurvivesTheLossIsHeld) {
  const TankRun survives = lift_with_a_death(14.5, 7);
  EXPECT_EQ(survives.status, Status::kReached) << survives.reason.c_str();
  EXPECT_TRUE(survives.summary.held) << survives.summary.missed;
  ASSERT_TRUE(survives.summary.after);
  EXPECT_EQ(survives.summary.after->t, 7);
  EXPECT_NEAR(survives.summary.after->mean, 14.5, 0.02 * 14.5);
  EXPECT_NEAR(survives.summary.after->last, 14.5, 0.02 * 14.5);
  EXPECT_LT(survives.summary.after->low, survives.summary.low);  // in the transient
  const TankRun lost = lift_with_a_death(20, 7);
  EXPECT_FALSE(lost.summary.held);
  EXPECT_EQ(lost.summary.missed, "the posture was lost");
  EXPECT_LT(lost.samples.back().t, 10);
}

/// Nothing changes before; afterwards the thruster exerts nothing, and no rate limit is violated by
/// its end.
TEST(TankDeath, TheThrusterExertsNothingFromThenOn) {
  const TankRun whole = lift_with_a_death(14.5, 14.5), dead = lift_with_a_death(14.5, 7);
  const Problem problem = load_problem("uvms/lift");
  const int i = death_of(problem.robot, "dies", kDyingThruster, 0).actuator;
  ASSERT_EQ(whole.samples.size(), dead.samples.size());
  double least = kInfinity;
  for (std::size_t k = 0; k < dead.samples.size(); ++k) {
    if (dead.samples[k].t <= 7 + 1e-6) {
      EXPECT_EQ(dead.samples[k].u, whole.samples[k].u) << k;
    } else {
      EXPECT_EQ(dead.samples[k].u[i], 0) << k;
      least = std::min(least, std::abs(whole.samples[k].u[i]));
    }
  }
  EXPECT_EQ(least, 0);  // it dies in the other run as well, at 14.5 s
  EXPECT_LT(dead.summary.violation, 1e-6);
}

/// A controller that counts on a thruster for a while lets the posture go farther, and the
/// transient takes longer.
TEST(TankDeath, ALateNoticeCosts) {
  const TankRun at_once = lift_with_a_death(14.5, 7), late = lift_with_a_death(14.5, 7, 1);
  ASSERT_TRUE(at_once.summary.after && late.summary.after);
  EXPECT_GT(late.summary.after->configuration_error,
            1.05 * at_once.summary.after->configuration_error);
}

/// The transient takes kTransient / bandwidth = 4 s. A hold that ends before says nothing.
TEST(TankDeath, AFailureNeedsTimeToSettle) {
  const TankRun run = lift_with_a_death(14.5, 12);
  EXPECT_FALSE(run.summary.held);
  EXPECT_EQ(run.summary.missed, "nothing is left after the transient of the last failure");
  EXPECT_TRUE(std::isnan(run.summary.after->mean));
}

/// The end of the hold is at 10 s: a death after it is no part of the hold.
TEST(TankDeath, OnlyTheHoldCounts) {
  const Problem problem = load_problem("uvms/lift");
  const Answer answer = evaluate(problem, problem.theta_r_default);
  TankOptions options;
  options.deaths = {death_of(problem.robot, "dies", kDyingThruster, 12)};
  const TankRun run = simulate_posture(answer, 29, "cvode", options);
  EXPECT_TRUE(run.summary.held) << run.summary.missed;
  EXPECT_FALSE(run.summary.after);
}

TEST(TankDeath, RejectsWhatCannotDie) {
  const Problem problem = load_problem("uvms/lift");
  const Answer answer = evaluate(problem, problem.theta_r_default);
  const auto line = [&](const std::vector<ActuatorDeath>& deaths, double noticed_after = 0) {
    TankOptions options;
    options.deaths = deaths;
    options.noticed_after = noticed_after;
    return rejection_of([&] { simulate_posture(answer, 5, "cvode", options); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(line({{0, -1}}), HasSubstr("dies: got -1"));
  EXPECT_THAT(line({{0, nan}}), HasSubstr("dies: got nan"));
  EXPECT_THAT(line({{0, 15}}), HasSubstr("expected a time before the end"));
  EXPECT_THAT(line({{-1, 1}}), HasSubstr("dies: got actuator -1"));
  EXPECT_THAT(line({{99, 1}}), HasSubstr("dies: got actuator 99"));
  EXPECT_THAT(line({{0, 1}, {0, 2}}), HasSubstr("twice"));
  EXPECT_THAT(line({{0, 1}}, nan), HasSubstr("noticed_after: got nan"));
  EXPECT_THAT(rejection_of([&] { death_of(problem.robot, "--dies", "rudder", 1); }),
              HasSubstr("--dies: got 'rudder', expected one of front_right"));
}

}  // namespace
}  // namespace maxwrench
