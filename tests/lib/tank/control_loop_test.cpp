#include "lib/tank/control_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "lib/tank/ode.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

constexpr double kPeriod = 0.01;  // s

/// Gives up in the middle of what it is asked for, with an unchanged state.
class GivesUpHalfway final : public Integrator {
 public:
  Status integrate(Ode& ode, const IntegratorOptions&, std::span<const double> times,
                   OdeSolution& trajectory) override {
    trajectory.start(times.front(), ode.initial());
    trajectory.t.push_back((times.front() + times.back()) / 2);
    trajectory.y.push_back(ode.initial());
    trajectory.conclude(Status::kBudgetExhausted, "no more steps");
    return trajectory.status;
  }
};

/// The vehicle at rest in its default posture, held by the cell, with efforts that carry its
/// weight: nothing moves.
struct AtRest {
  explicit AtRest(const TankOptions& choice = {})
      : problem(load_problem("uvms/valve")),
        options(choice),
        posture(PostureEvaluator(problem).evaluate(problem.theta_r_default)),
        ode(problem, posture, options),
        tracker(VectorXd::Ones(problem.robot.actuators())),
        integrator(find_integrator("cvode").make()),
        loop(problem, options, *integrator, ode, tracker),
        u(problem.robot.actuation.B_pinv * posture.tau_d) {
    ode.start({posture.base, posture.q, VectorXd::Zero(problem.robot.velocities())}, u);
    ask(u);
  }
  /// For B u, close to u, within the robot's own limits.
  void ask(const VectorXd& of) {
    const Zonotope& set = problem.robot.actuation;
    loop.request = {set.B, set.B * of, of, set.u_min, set.u_max};
  }
  double step(double t = 0) {
    return loop.step(t, u, t + kPeriod, Vector6d::Zero(), Vector6d::Zero());
  }
  Problem problem;
  TankOptions options;
  Posture posture;
  TankOde ode;
  EffortTracker tracker;
  std::unique_ptr<Integrator> integrator;
  ControlLoop loop;
  VectorXd u;
};

TEST(ControlLoop, WhatBalancesIsLeftAlone) {
  AtRest rest;
  const VectorXd before = rest.ode.initial();
  for (int k = 0; k < 5; ++k) EXPECT_DOUBLE_EQ(rest.step(k * kPeriod), (k + 1) * kPeriod);
  EXPECT_LT((rest.ode.initial() - before).norm(), 1e-7);  // the integrator has 1e-8
  const TankSample sample = rest.loop.sample(4 * kPeriod, 5 * kPeriod);
  EXPECT_EQ(sample.t, 5 * kPeriod);
  EXPECT_LT((sample.u - rest.u).norm(), 1e-9);
  EXPECT_LT(sample.shortfall, 1e-9);
  EXPECT_LT(sample.violation, 1e-9);
  EXPECT_FALSE(sample.saturated);
  EXPECT_FALSE(sample.relaxed);
  EXPECT_TRUE(rest.loop.goes_on());
  const TankRun& run = rest.loop.finish();
  EXPECT_EQ(run.status, Status::kReached);
  EXPECT_EQ(run.requests, 5);
  EXPECT_EQ(run.evaluations, rest.ode.evaluations());
  EXPECT_GT(run.evaluations, 0);
}

/// A request whose limits are not the robot's: a joint's torque, which is at once what it was told,
/// 3 N m above its limit, and a thruster 10 N above its own, whose lag keeps the thrust itself
/// below.
TEST(ControlLoop, SaysHowFarEffortsLeaveTheirLimits) {
  for (const bool thruster : {false, true}) {
    AtRest rest;
    const VectorXd& most = rest.problem.robot.actuation.u_max;
    const Eigen::Index i = thruster ? 0 : rest.u.size() - 1;
    VectorXd beyond = rest.u;
    beyond[i] = most[i] + (thruster ? 10 : 3);
    rest.ask(beyond);
    rest.loop.request.lower.setConstant(-1000);
    rest.loop.request.upper.setConstant(1000);
    rest.step();
    const TankSample sample = rest.loop.sample(0, kPeriod);
    EXPECT_NEAR(sample.violation, thruster ? 10 : 3, 1e-9);
    EXPECT_EQ(sample.u[i] > most[i], !thruster);
  }
}

/// A thruster whose efforts at the start and the end of a period are d apart changes by d / period,
/// less what its limit allows. It hardly moves here; the efforts at the start are said to be 1 N
/// more than its thrust.
TEST(ControlLoop, SaysHowFarRatesLeaveTheirLimits) {
  AtRest rest;
  const double rate = rest.problem.robot.u_rate_max[0];
  ASSERT_LT(rate, kInfinity);
  VectorXd told = rest.u;
  told[0] += 1;
  rest.loop.step(0, told, kPeriod, Vector6d::Zero(), Vector6d::Zero());
  const TankSample sample = rest.loop.sample(0, kPeriod);
  const double changed = std::abs(sample.u[0] - told[0]);
  EXPECT_NEAR(sample.violation, changed / kPeriod - rate, 1e-6);
  EXPECT_GT(sample.violation, 1);
}

TEST(ControlLoop, AnswersWhatIsBeyondReachWithTheMostThereIs) {
  AtRest rest;
  rest.ask(100 * (rest.u.array().abs() + 1).matrix());
  rest.step();
  const TankSample sample = rest.loop.sample(0, kPeriod);
  EXPECT_TRUE(sample.saturated);
  EXPECT_TRUE(sample.relaxed);
  EXPECT_GT(sample.shortfall, 1);
  EXPECT_LT(sample.violation, 1e-6);
}

TEST(ControlLoop, EndsWhereTheIntegratorGivesUp) {
  AtRest rest;
  GivesUpHalfway integrator;
  ControlLoop loop(rest.problem, rest.options, integrator, rest.ode, rest.tracker);
  loop.request = rest.loop.request;
  EXPECT_DOUBLE_EQ(loop.step(0, rest.u, kPeriod, Vector6d::Zero(), Vector6d::Zero()), kPeriod / 2);
  EXPECT_FALSE(loop.goes_on());
  EXPECT_EQ(loop.finish().status, Status::kBudgetExhausted);
  EXPECT_STREQ(loop.run.reason.c_str(), "no more steps");
}

TEST(ControlLoop, IsLostBeyondTheLimitOnly) {
  AtRest rest;
  EXPECT_FALSE(rest.loop.lost());
  for (double TankSample::*far : {&TankSample::theta_r_error, &TankSample::position_error}) {
    TankSample& sample = rest.loop.run.samples.emplace_back();
    sample.*far = kLost;
    EXPECT_FALSE(rest.loop.lost());
    EXPECT_TRUE(rest.loop.goes_on());
    sample.*far = std::nextafter(kLost, 1);
    EXPECT_TRUE(rest.loop.lost());
    EXPECT_FALSE(rest.loop.goes_on());
    EXPECT_EQ(rest.loop.run.status, Status::kReached);
  }
  rest.loop.run.samples.emplace_back();  // only the last one counts
  EXPECT_FALSE(rest.loop.lost());
}

/// The same noise for the same seed, and none without.
TEST(ControlLoop, DrawsNoiseByItsSeed) {
  const auto end = [](double noise, std::uint64_t seed) {
    TankOptions options;
    options.imperfections.thrust_noise = noise;
    options.imperfections.seed = seed;
    AtRest rest(options);
    for (int k = 0; k < 3; ++k) rest.step(k * kPeriod);
    return VectorXd(rest.ode.initial());
  };
  const VectorXd quiet = end(0, 1), one = end(0.5, 1);
  EXPECT_EQ(quiet, end(0, 2));
  EXPECT_EQ(one, end(0.5, 1));
  EXPECT_GT((one - end(0.5, 2)).norm(), 1e-9);
  EXPECT_GT((one - quiet).norm(), 1e-9);
}

}  // namespace
}  // namespace maxwrench
