#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lib/tank/summary.h"
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
TEST(TankDeath, SLOW_WhatSurvivesTheLossIsHeld) {
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
TEST(TankDeath, SLOW_TheThrusterExertsNothingFromThenOn) {
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
TEST(TankDeath, SLOW_ALateNoticeCosts) {
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
TEST(TankDeath, SLOW_OnlyTheHoldCounts) {
  const Problem problem = load_problem("uvms/lift");
  const Answer answer = evaluate(problem, problem.theta_r_default);
  TankOptions options;
  options.deaths = {death_of(problem.robot, "dies", kDyingThruster, 12)};
  const TankRun run = simulate_posture(answer, 29, "cvode", options);
  EXPECT_TRUE(run.summary.held) << run.summary.missed;
  EXPECT_FALSE(run.summary.after);
}

constexpr double kSamplePeriod = 0.1;

/// A run to `end` with a reading that is a function of time.
template <class Reading>
TankRun run_reading(const Problem& problem, double end, const Reading& reading) {
  TankRun run;
  for (int k = 1; k * kSamplePeriod <= end + kSamplePeriod / 2; ++k) {
    TankSample sample;
    sample.t = k * kSamplePeriod;
    sample.reading = reading(sample.t);
    sample.h_e = sample.reading * problem.c;
    run.samples.push_back(sample);
  }
  run.conclude(Status::kReached);
  return run;
}

/// The summary of a hold of 10 N from 5 s to 15 s, with these deaths.
template <class Reading>
TankSummary hold_with_deaths(const std::vector<ActuatorDeath>& deaths, const Reading& reading) {
  const Problem problem = load_problem("planar/force");
  TankOptions options;
  options.period = kSamplePeriod;
  options.ramp = 5;
  options.hold = 10;
  options.deaths = deaths;
  const TargetWrench target{10 * problem.c, {}, Wrench::kPure, 10};
  return summarise(problem, target, options, run_reading(problem, 20, reading), false);
}

TEST(TankDeath, OneAfterTheHoldHidesNoEarlierOne) {
  const auto reading = [](double t) { return t > 14 ? 9.4 : 10; };
  const TankSummary alone = hold_with_deaths({{0, 9}}, reading);
  const TankSummary both = hold_with_deaths({{0, 9}, {1, 17}}, reading);
  EXPECT_FALSE(alone.held);
  EXPECT_THAT(alone.missed, HasSubstr("reading after the last failure"));
  EXPECT_EQ(both.missed, alone.missed);
  ASSERT_TRUE(both.after);
  EXPECT_EQ(both.after->t, 9);
}

/// The ramp has ended at 5 s.
TEST(TankDeath, TheRampDoesNotCount) {
  const TankSummary summary =
      hold_with_deaths({{0, 0}}, [](double t) { return std::min(10.0, 2 * t); });
  EXPECT_TRUE(summary.held) << summary.missed;
  ASSERT_TRUE(summary.after);
  EXPECT_NEAR(summary.after->mean, 10, 1e-9);
  EXPECT_NEAR(summary.after->low, 10, 1e-9);
}

/// An impulse with its peak at 1 s, in which the reading falls as soon as an actuator fails.
TEST(TankDeath, AnImpulseWithItsPeakInTheTransientIsNotHeld) {
  const Problem problem = load_problem("planar/force");
  TankScript script;
  script.planned = 10;
  script.t_h = 1;
  TankOptions options;
  options.period = kSamplePeriod;
  for (const double dies : {0.0, 0.9}) {
    options.deaths = {{0, dies}};
    const TankRun run = run_reading(problem, 2, [&](double t) { return t > dies + 0.01 ? 3 : 10; });
    const TankSummary summary = summarise(script, options, run, false);
    EXPECT_FALSE(summary.held) << dies;
    EXPECT_EQ(summary.missed, "the peak is in the transient of a failure");
    EXPECT_EQ(summary.motion->at_peak, 3);
    EXPECT_TRUE(std::isfinite(summary.low) && std::isfinite(summary.mean));
  }
  options.deaths = {{0, 1.5}};
  const TankRun later = run_reading(problem, 2, [](double) { return 10; });
  EXPECT_TRUE(summarise(script, options, later, false).held);
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
