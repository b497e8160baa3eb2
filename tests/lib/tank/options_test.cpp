#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/tank.h"
#include "maxwrench/trajectory.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A number of the options, and whether it may be zero.
struct TankNumber {
  const char* key;
  std::function<double&(TankOptions&)> of;
  bool may_be_zero;
};

const TankNumber kTankNumbers[] = {
    {"ramp", [](TankOptions& o) -> double& { return o.ramp; }, false},
    {"hold", [](TankOptions& o) -> double& { return o.hold; }, true},
    {"period", [](TankOptions& o) -> double& { return o.period; }, false},
    {"thruster_lag", [](TankOptions& o) -> double& { return o.thruster_lag; }, false},
    {"bandwidth", [](TankOptions& o) -> double& { return o.bandwidth; }, true},
    {"margin", [](TankOptions& o) -> double& { return o.margin; }, true},
    {"load", [](TankOptions& o) -> double& { return o.load; }, true},
    {"cell.stiffness_linear", [](TankOptions& o) -> double& { return o.cell.stiffness_linear; },
     false},
    {"cell.stiffness_angular", [](TankOptions& o) -> double& { return o.cell.stiffness_angular; },
     false},
    {"cell.damping_linear", [](TankOptions& o) -> double& { return o.cell.damping_linear; }, true},
    {"cell.damping_angular", [](TankOptions& o) -> double& { return o.cell.damping_angular; },
     true},
    {"imperfections.thrust_efficiency",
     [](TankOptions& o) -> double& { return o.imperfections.thrust_efficiency; }, true},
    {"imperfections.thrust_noise",
     [](TankOptions& o) -> double& { return o.imperfections.thrust_noise; }, true},
    {"integrator relative_tolerance",
     [](TankOptions& o) -> double& { return o.integrator.relative_tolerance; }, true},
    {"integrator absolute_tolerance",
     [](TankOptions& o) -> double& { return o.integrator.absolute_tolerance; }, false},
    {"integrator step", [](TankOptions& o) -> double& { return o.integrator.step; }, false},
};

TEST(TankOptions, RejectEachNumberOutOfRange) {
  EXPECT_NO_THROW(check(TankOptions()));
  for (const TankNumber& number : kTankNumbers) {
    SCOPED_TRACE(number.key);
    for (const double value : {-1.0, kNoNumber, kInfinity, -kInfinity}) {
      TankOptions options;
      number.of(options) = value;
      expect_rejected(number.key, [&] { check(options); });
    }
    TankOptions options;
    number.of(options) = 0;
    if (number.may_be_zero) {
      EXPECT_NO_THROW(check(options));
    } else {
      expect_rejected(number.key, [&] { check(options); });
    }
  }
}

TEST(TankOptions, RejectWhatLeavesNothingOrHasNoEnd) {
  TankOptions all, endless, no_steps;
  all.margin = 1;  // nothing would be asked for
  expect_rejected("margin", [&] { check(all); });
  endless.period = 1e-9;
  expect_rejected("period", [&] { check(endless); });
  no_steps.integrator.max_steps = 0;
  expect_rejected("integrator max_steps", [&] { check(no_steps); });
}

TEST(ScriptOptions, RejectEachNumberOutOfRange) {
  EXPECT_NO_THROW(check(ScriptOptions()));
  for (const double value : {-1.0, kNoNumber, kInfinity}) {
    expect_rejected("planned", [&] { check(ScriptOptions{.planned = value}); });
    expect_rejected("margin", [&] { check(ScriptOptions{.margin = value}); });
  }
  expect_rejected("margin", [] { check(ScriptOptions{.margin = 1}); });
}

/// Both experiments and the script look at their options.
TEST(TankOptions, AreCheckedByTheExperiments) {
  const Problem problem = load_problem("planar/trajectory");
  TrajectoryEvaluator trajectories(problem, Wrench::kPure, trajectory_solvers().front().make);
  trajectories.evaluate(constant_knots(problem, problem.theta_r_default));
  trajectories.evaluate_between_knots();
  const auto solver = trajectory_solvers().front().make();
  expect_rejected("margin", [&] {
    make_script(problem, trajectories.trajectory(), Wrench::kPure, *solver, {.margin = kNoNumber});
  });
  const TankScript script =
      make_script(problem, trajectories.trajectory(), Wrench::kPure, *solver, {});
  ASSERT_EQ(script.status, Status::kOptimal) << script.reason.c_str();
  TankOptions bad;
  bad.period = 0;
  const auto integrator = integrators().front().make();
  expect_rejected("period", [&] { run_tank(problem, script, *integrator, bad); });
  const Problem still = load_problem("fixed/push");
  Posture posture;
  TargetWrench trajectory;
  trajectory.h.setZero();
  expect_rejected("period", [&] { run_tank(still, posture, trajectory, *integrator, bad); });
}

TEST(TankOptions, RobotsThatCannotMoveInTheTankAreRejected) {
  Robot robot = load_problem("planar/force").robot;
  EXPECT_NO_THROW(check(robot));
  robot.no_dynamics = {{"link[tip].inertial.mass", "0", "a mass > 0"}};
  expect_rejected("link[tip].inertial.mass: got 0", [&] { check(robot); });
  robot.no_dynamics.clear();
  robot.joints[1].gear = Gear{.leader = 0};
  expect_rejected("joint[elbow].mimic", [&] { check(robot); });
}

}  // namespace
}  // namespace maxwrench
