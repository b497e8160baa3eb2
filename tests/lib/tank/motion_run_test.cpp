#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "maxwrench/tank.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector4d;
using std::numbers::pi;

/// The best static posture of uvms/valve, rounded.
const Vector4d kStill(3.0643, 0.6895, 0.4288, -3.0278);

/// An impulse of `backward` that a search found, rounded: 39.6 N m by its own four steps, without a
/// motion that is one.
const double kBackward[4][4] = {{3.070, 0.772, 0.453, -2.983},
                                {3.046, 0.550, 0.615, -3.008},
                                {3.156, 0.709, 0.477, -3.048},
                                {3.035, 0.656, 0.474, -2.968}};

TankScript script_of(const Problem& problem, const MatrixXd& knots, ScriptOptions options = {},
                     Wrench wrench = Wrench::kPure) {
  const TrajectorySolverEntry& lp = trajectory_solvers().front();
  TrajectoryEvaluator evaluator(problem, wrench, lp.make);
  evaluator.evaluate(knots);
  evaluator.evaluate_between_knots();
  return make_script(problem, evaluator.trajectory(), wrench, *lp.make(), options);
}

TankRun run(const Problem& problem, const TankScript& script, const TankOptions& options = {}) {
  return run_tank(problem, script, *find_integrator("cvode").make(), options);
}

Problem turn_of(Scheme scheme) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.motion->scheme = scheme;
  return problem;
}

void expect_within_limits(const TankRun& tank) {
  ASSERT_EQ(tank.status, Status::kReached) << tank.reason.c_str();
  EXPECT_LT(tank.summary.violation, 1e-6);
  EXPECT_EQ(tank.summary.motion->speed, 0);
  EXPECT_EQ(tank.summary.motion->violations, 0);
}

/// 34.30164 is `value_between_knots` of the fixed posture in an independent model.
TEST(TankMotion, ASplineTurnReadsWhatIsAskedForAllAlong) {
  const Problem problem = turn_of(Scheme::kSpline);
  const TankScript script = script_of(problem, constant_knots(problem, kStill));
  ASSERT_EQ(script.status, Status::kOptimal);
  EXPECT_NEAR(script.planned, 34.30164, 1e-4);
  EXPECT_LT(script.slack, 1e-9);
  const TankRun tank = run(problem, script);
  expect_within_limits(tank);
  const double asked = (1 - script.margin) * script.planned;
  EXPECT_NEAR(tank.summary.low, asked, 1e-3);
  EXPECT_NEAR(tank.summary.high, asked, 1e-3);
  EXPECT_TRUE(tank.summary.held);
  EXPECT_EQ(tank.samples.size(), 500U);
  EXPECT_LT(tank.summary.deflection_error, 1e-6);
  EXPECT_LT(tank.summary.configuration_error, 1e-3);
  // The cell turns by 180 degrees; what bends it at the end is there from the start.
  EXPECT_NEAR(tank.samples.back().angle, pi, 1e-6);
  EXPECT_NEAR(tank.samples[249].angle, pi / 2, 1e-6);
}

TEST(TankMotion, SLOW_EachSchemesTurnAtRestIsHeld) {
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    const Problem problem = turn_of(scheme);
    const TankScript script = script_of(problem, constant_knots(problem, kStill),
                                        {.interpolation = Interpolation::kLinear});
    EXPECT_EQ(script.instants.size(), 10U);
    EXPECT_EQ(script.instants.back().t, 5);
    const TankRun tank = run(problem, script);
    expect_within_limits(tank);
    EXPECT_TRUE(tank.summary.held) << to_string(scheme);
  }
}

/// The elbow and the wrist of the wheeled base follow from theta_r, here on a curve.
TEST(TankMotion, ADoorIsPushedWithJointsThatFollow) {
  const Problem problem = load_problem("mobile/trajectory");
  MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  for (Eigen::Index i = 0; i < knots.rows(); ++i) {
    knots.row(i) += 0.05 * static_cast<double>(i) * Eigen::RowVector2d(1, -1);
  }
  const TankScript script = script_of(problem, knots);
  ASSERT_EQ(script.status, Status::kOptimal) << script.reason.c_str();
  const TankRun tank = run(problem, script);
  expect_within_limits(tank);
  EXPECT_TRUE(tank.summary.held) << tank.summary.missed;
  EXPECT_LT(tank.summary.configuration_error, 1e-3);
  EXPECT_NEAR(tank.summary.low, script.planned, kTrackedWrenchError * script.planned);
  EXPECT_NEAR(tank.samples.back().angle, pi / 3, 1e-4);
}

/// Only c'h is fixed; the cell takes the rest.
TEST(TankMotion, FreeComponentsAreLeftToTheCell) {
  const Problem problem = turn_of(Scheme::kSpline);
  const TankScript script = script_of(problem, constant_knots(problem, kStill), {}, Wrench::kAny);
  EXPECT_GT(script.planned, 40);
  for (const Instant& instant : script.instants) {
    EXPECT_NEAR(instant.beta(), (1 - script.margin) * script.planned, 1e-9);
    EXPECT_GT((instant.h - instant.beta() * instant.c).norm(), 0.1);
  }
  const TankRun tank = run(problem, script);
  expect_within_limits(tank);
  EXPECT_TRUE(tank.summary.held);
}

TEST(TankMotion, ASplineImpulseReadsItsPeak) {
  const Problem problem = load_problem("uvms/valve_impulse");
  const TankScript script = script_of(problem, constant_knots(problem, problem.motion->theta_0));
  EXPECT_NEAR(script.t_h, 2.5 * 3 / 4, 1e-12);
  const TankRun tank = run(problem, script);
  expect_within_limits(tank);
  EXPECT_TRUE(tank.summary.held);
  const MotionSummary& motion = *tank.summary.motion;
  EXPECT_NEAR(motion.at_peak, script.planned, kTrackedWrenchError * script.planned);
  EXPECT_NEAR(motion.t_high, script.t_h, 0.1);
  EXPECT_GT(motion.at_peak, tank.samples[99].reading);  // at 1 s
}

/// Its four steps hide a motion that no efforts make: the cell reads about as much without one.
TEST(TankMotion, SLOW_ABackwardImpulseDoesNotReachItsPeak) {
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->scheme = Scheme::kBackward;
  const MatrixXd knots =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&kBackward[0][0]);
  const TankScript script = script_of(problem, knots, {.interpolation = Interpolation::kLinear});
  ASSERT_EQ(script.status, Status::kOptimal) << script.reason.c_str();
  EXPECT_GT(script.planned, 38);
  const TankRun tank = run(problem, script);
  EXPECT_FALSE(tank.summary.held);
  EXPECT_THAT(tank.summary.missed, testing::HasSubstr("reading off by"));
  EXPECT_LT(tank.summary.motion->at_peak, 0.95 * script.planned);
  EXPECT_LT(tank.summary.violation, 1e-6);
  const TankScript spline = script_of(problem, knots);
  EXPECT_EQ(spline.status, Status::kInfeasible);
  EXPECT_THAT(spline.reason.str(), testing::HasSubstr("violated"));
}

/// One knot: the robot rests, so it reads what it does in the static experiment.
TEST(TankMotion, SLOW_OneKnotIsTheStaticTank) {
  Problem problem = turn_of(Scheme::kEnds);
  problem.motion->k = 1;
  const TankScript script = script_of(problem, constant_knots(problem, kStill));
  const TankRun tank = run(problem, script);
  expect_within_limits(tank);
  const Problem still = load_problem("uvms/valve");
  const Answer row = evaluate(still, kStill, {{still.name, "linf_polytope"}});
  EXPECT_NEAR(script.planned, row.capability.beta, 1e-6);
  const TankRun held =
      run_tank(still, row.posture, {row.capability.h, row.capability.u, Wrench::kPure},
               *find_integrator("cvode").make(), {});
  // In the middle of the hold, where nothing moves any more.
  const TankSample& hold = held.samples[899];
  EXPECT_NEAR(tank.samples.back().reading, hold.reading, 2e-3 * hold.reading);
  EXPECT_NEAR(tank.samples.back().reading, (1 - script.margin) * script.planned, 1e-3);
  EXPECT_LT(std::abs(tank.samples.back().angle), 1e-9);
}

/// Gravity and water look alike from all sides: a task turned about the vertical reads the same.
TEST(TankMotion, SLOW_ATaskTurnedAboutTheVerticalReadsTheSame) {
  const Problem problem = turn_of(Scheme::kSpline);
  Problem turned = problem;
  turned.pose.R = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  turned.motion->path = Path::screw(turned.pose, Eigen::Vector3d::UnitZ(), turned.pose.p, pi,
                                    {0, 0, 0}, Timing::kCubic, problem.motion->T);
  const TankRun a = run(problem, script_of(problem, constant_knots(problem, kStill)));
  const TankRun b = run(turned, script_of(turned, constant_knots(turned, kStill)));
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); i += 50) {
    EXPECT_NEAR(a.samples[i].reading, b.samples[i].reading, 1e-3);
    EXPECT_LT((a.samples[i].theta_r - b.samples[i].theta_r).norm(), 1e-6);
  }
}

/// Every sample of two runs.
bool same_samples(const TankRun& a, const TankRun& b) {
  return std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const TankSample& x, const TankSample& y) {
                      return x.h_e == y.h_e && x.u == y.u && x.theta_r == y.theta_r;
                    });
}

TEST(TankMotion, SLOW_RepeatsBitForBitAndNoiseBySeed) {
  const Problem problem = load_problem("uvms/valve_impulse");
  const TankScript script = script_of(problem, constant_knots(problem, problem.motion->theta_0));
  TankOptions options;
  const TankRun perfect = run(problem, script, options);
  options.imperfections.seed = 4;
  EXPECT_TRUE(same_samples(run(problem, script, options), perfect));  // no noise, no seed
  options.imperfections.thrust_noise = 0.5;
  const TankRun noisy = run(problem, script, options);
  EXPECT_TRUE(same_samples(run(problem, script, options), noisy));
  options.imperfections.seed = 5;
  EXPECT_FALSE(same_samples(run(problem, script, options), noisy));
}

TEST(TankMotion, ALastPeriodEndsWithTheTask) {
  const Problem problem = turn_of(Scheme::kSpline);
  TankOptions options;
  options.period = 0.03;  // 166 periods and 2/3
  const TankRun tank = run(problem, script_of(problem, constant_knots(problem, kStill)), options);
  expect_within_limits(tank);
  EXPECT_EQ(tank.samples.size(), 167U);
  EXPECT_EQ(tank.samples.back().t, 5);
}

TEST(TankMotion, AnInterruptionKeepsThePeriodsBeforeIt) {
  const Problem problem = load_problem("planar/trajectory");
  const TankScript script = script_of(problem, constant_knots(problem, problem.theta_r_default));
  ASSERT_EQ(script.status, Status::kOptimal) << script.reason.c_str();
  TankOptions options;
  int asked = 0;
  options.interrupted = [&asked] { return ++asked > 20; };
  const TankRun part = run(problem, script, options);
  EXPECT_EQ(part.status, Status::kBudgetExhausted);
  EXPECT_EQ(part.reason.str(), "interrupted");
  EXPECT_EQ(part.samples.size(), 20U);
  EXPECT_FALSE(part.summary.held);
}

TEST(TankMotion, SaysWhyThereIsNothingToRun) {
  const Problem problem = turn_of(Scheme::kSpline);
  const TankScript beyond = script_of(problem, constant_knots(problem, Vector4d(9, 0, 0, 0)));
  EXPECT_EQ(beyond.status, Status::kInvalidPosture);
  EXPECT_FALSE(beyond.reason.empty());
  EXPECT_THROW(run(problem, beyond), std::invalid_argument);
  EXPECT_THROW(parse_interpolation("cubic"), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
