#include "maxwrench/tank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "lib/robot/free_motion.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::VectorXd;

/// Postures to try, not expected values: the default and three near optima.
struct Experiment {
  const char* name;
  Wrench wrench;
  Eigen::Vector4d theta_r;
};

std::ostream& operator<<(std::ostream& out, const Experiment& e) { return out << e.name; }

const Eigen::Vector4d kDefault(3.141592653589793, 0.4, 1.9707963267948966, 0);
const Eigen::Vector4d kBeta1(2.8791, 0.4281, 0.4288, -3.1386);
const Experiment kExperiments[] = {
    {"default", Wrench::kPure, kDefault},
    {"beta_1", Wrench::kPure, kBeta1},
    {"beta_2", Wrench::kPure, {3.0643, 0.6895, 0.4288, -3.0278}},
    {"beta_3", Wrench::kAny, {4.6061, 1.8815, 2.1509, -0.2632}},
};

/// What any efforts reach at a posture; with `measure` another trajectory.
Answer planned(const Problem& problem, Wrench wrench, const VectorXd& theta_r,
               const char* measure = "linf_polytope") {
  return evaluate(problem, theta_r, {{problem.name, measure, wrench}});
}

TankRun run(const Problem& problem, const Answer& row, double extra,
            const TankOptions& options = {}, const char* integrator = "cvode") {
  const TargetWrench trajectory{row.capability.h + extra * problem.c, row.capability.u,
                                row.choice.wrench};
  return run_tank(problem, row.posture, trajectory, *find_integrator(integrator).make(), options);
}

void expect_held(const TankRun& tank) {
  ASSERT_EQ(tank.status, Status::kReached) << tank.reason.c_str();
  const TankSummary& s = tank.summary;
  EXPECT_TRUE(s.held) << s.theta_r_error;
  EXPECT_GT(s.low, 0.98 * s.planned);
  EXPECT_LT(s.high, 1.02 * s.planned);
  EXPECT_LT(s.theta_r_error, kHeldThetaRError);
  EXPECT_LT(s.violation, 1e-6);  // of efforts and rates; what the integrator leaves
}

/// The efforts are at their limits, the request is not met, and the posture goes.
void expect_saturated_and_adrift(const TankRun& tank) {
  ASSERT_EQ(tank.status, Status::kReached) << tank.reason.c_str();
  const TankSummary& s = tank.summary;
  EXPECT_FALSE(s.held);
  EXPECT_EQ(s.saturated, 1);
  EXPECT_GT(s.relaxed, 0.5);
  EXPECT_GT(s.theta_r_error, kHeldThetaRError);
  EXPECT_LT(s.violation, 1e-6);
}

class TankTest : public testing::TestWithParam<Experiment> {};
INSTANTIATE_TEST_SUITE_P(Static, TankTest, testing::ValuesIn(kExperiments),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(TankTest, SLOW_TheCellReadsWhatWasPlannedWithinTheLimits) {
  const Problem problem = load_problem("uvms/valve");
  const TankRun tank = run(problem, planned(problem, GetParam().wrench, GetParam().theta_r), 0);
  expect_held(tank);
  EXPECT_EQ(tank.samples.size(), 1500U);
  EXPECT_EQ(tank.summary.relaxed, 0);
}

TEST_P(TankTest, SLOW_OneNewtonMetreMoreIsNotHeld) {
  const Problem problem = load_problem("uvms/valve");
  expect_saturated_and_adrift(
      run(problem, planned(problem, GetParam().wrench, GetParam().theta_r), 1));
}

TEST(Tank, SLOW_RandomPosturesHoldWhatIsPlannedAndNoMore) {
  const Problem problem = load_problem("uvms/valve");
  TankOptions options;
  options.hold = 3;
  options.until_hold = true;
  Random random(5);
  for (int found = 0; found < samples(10);) {
    const Wrench wrench = found % 2 == 0 ? Wrench::kPure : Wrench::kAny;
    const Answer row = planned(problem, wrench, random_theta_r(problem, random));
    if (!row.has_value() || row.capability.beta <= 1) continue;
    SCOPED_TRACE(testing::Message() << found << ": " << row.posture.theta_r.transpose());
    expect_held(run(problem, row, 0, options));
    expect_saturated_and_adrift(run(problem, row, 1, options));
    ++found;
  }
}

/// beta_1 is what an ellipsoid inside the polytope reaches, so there is room beyond it.
TEST(Tank, SLOW_TheEllipsoidsTrajectoryAndOneNewtonMetreMoreAreHeld) {
  const Problem problem = load_problem("uvms/valve");
  TankOptions options;
  options.until_hold = true;
  const Answer row = planned(problem, Wrench::kPure, kBeta1, "ellipsoid");
  expect_held(run(problem, row, 0, options));
  expect_held(run(problem, row, 1, options));
}

/// Their readings differ by what the tolerances leave: a step's error of about tolerance times 1 m
/// (the size of the state) displaces the cell by as much, and steps add up.
TEST(Tank, SLOW_IdaAndCvodeGiveTheSameWrench) {
  const Problem problem = load_problem("uvms/valve");
  const Answer row = planned(problem, kExperiments[2].wrench, kExperiments[2].theta_r);
  TankOptions options;
  options.ramp = 2;
  options.hold = 0.2;
  options.until_hold = true;
  for (const double tolerance : {1e-6, 1e-8}) {
    options.integrator.relative_tolerance = tolerance;
    options.integrator.absolute_tolerance = tolerance / 100;
    const TankRun a = run(problem, row, -10, options);
    const TankRun b = run(problem, row, -10, options, "ida");
    ASSERT_EQ(a.samples.size(), 220U);
    ASSERT_EQ(b.samples.size(), 220U);
    double worst = 0, torque = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
      worst = std::max(worst, (a.samples[i].h_e - b.samples[i].h_e).norm());
      torque = std::max(torque, std::abs(problem.c.dot(a.samples[i].h_e)));
    }
    // What was asked for; the posture's errors cost a share of what is left of the margin.
    const double asked = (1 - options.margin) * (row.capability.beta - 10);
    EXPECT_NEAR(torque, asked, options.margin * asked);
    EXPECT_LT(worst, options.cell.stiffness_linear * tolerance) << tolerance;
  }
}

/// Every sample of two runs.
bool same_rows(const TankRun& a, const TankRun& b) {
  return std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const TankSample& x, const TankSample& y) {
                      return x.h_e == y.h_e && x.u == y.u && x.theta_r_error == y.theta_r_error;
                    });
}

TEST(Tank, ImperfectionsAreOffAndRepeatBySeed) {
  const Problem problem = load_problem("uvms/valve");
  const Answer row = planned(problem, Wrench::kPure, kBeta1, "ellipsoid");
  TankOptions options;
  options.ramp = 1;
  options.hold = 0.2;
  options.until_hold = true;
  const TankRun perfect = run(problem, row, 0, options);
  options.imperfections.seed = 4;
  EXPECT_TRUE(same_rows(run(problem, row, 0, options), perfect));  // no noise, no seed
  options.imperfections.thrust_efficiency = 0.9;
  EXPECT_LT(run(problem, row, 0, options).summary.mean, 0.99 * perfect.summary.mean);
  options.imperfections.thrust_noise = 0.5;
  const TankRun noisy = run(problem, row, 0, options);
  EXPECT_TRUE(same_rows(run(problem, row, 0, options), noisy));
  options.imperfections.seed = 5;
  EXPECT_FALSE(same_rows(run(problem, row, 0, options), noisy));
}

/// The load is a mass point at the end effector: kinetic energy m v_e'v_e/2 more, weight m g more.
TEST(Tank, ALoadIsAPartOfTheRobot) {
  const Problem problem = load_problem("uvms/lift");
  const double mass = 3;
  Robot robot = problem.robot;
  const EndEffector& tool = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
  add_body(robot.links[static_cast<std::size_t>(tool.link)], mass, tool.placement.p,
           Eigen::Matrix3d::Zero());
  const Answer row = planned(problem, Wrench::kPure, kDefault);
  Dynamics bare(problem.robot), carrying(robot);
  Eigen::MatrixXd M_bare, M;
  VectorXd g_bare(problem.robot.velocities()), g(g_bare.size());
  bare.set_configuration(row.posture.base.R, row.posture.q);
  carrying.set_configuration(row.posture.base.R, row.posture.q);
  bare.mass_matrix(M_bare);
  carrying.mass_matrix(M);
  bare.gravity(g_bare);
  carrying.gravity(g);
  const Eigen::MatrixXd J_v = row.posture.J.topRows<3>();
  EXPECT_LT((M - M_bare - mass * J_v.transpose() * J_v).norm(), 1e-12 * M.norm());
  const VectorXd weight = mass * robot.gravity * J_v.row(2).transpose();
  EXPECT_LT((g - g_bare - weight).norm(), 1e-12 * g.norm());
}

/// The whole kilograms that the polytope allows are carried, one more is lost.
TEST(Tank, SLOW_CarriesWhatThePolytopeAllows) {
  const Problem problem = load_problem("uvms/lift");
  const Eigen::Vector4d postures[] = {
      kDefault, {1.7188, 2.0213, 0.4288, -0.5092}, {1.6426, 2.5143, 0.4288, -1.0989}};
  TankOptions options;
  options.until_hold = true;
  for (const Eigen::Vector4d& theta_r : std::span(postures, 3)) {
    const Answer row = planned(problem, Wrench::kPure, theta_r);
    const double most = std::floor(row.capability.beta / problem.robot.gravity);
    for (const double mass : {most, most + 1}) {
      options.load = mass;
      const double extra = mass * problem.robot.gravity - row.capability.beta;
      const TankRun tank = run(problem, row, extra, options);
      ASSERT_EQ(tank.status, Status::kReached) << tank.reason.c_str();
      EXPECT_EQ(tank.summary.held, mass == most) << mass;
      EXPECT_LT(tank.summary.violation, 1e-6);
      if (mass > most) {
        EXPECT_GT(tank.summary.theta_r_error, kHeldThetaRError);
      }
    }
  }
}

TEST(Tank, AnInterruptionKeepsThePeriodsBeforeIt) {
  const Problem problem = load_problem("planar/force");
  const Answer row = planned(problem, Wrench::kPure, Eigen::Vector2d::Zero());
  TankOptions options;
  options.ramp = 0.3;
  options.hold = 0.4;
  const TankRun whole = run(problem, row, 0, options);
  ASSERT_EQ(whole.status, Status::kReached) << whole.reason.c_str();
  int asked = 0;
  options.interrupted = [&asked] { return ++asked > 50; };  // during the hold
  const TankRun part = run(problem, row, 0, options);
  EXPECT_EQ(part.status, Status::kBudgetExhausted);
  EXPECT_EQ(part.reason.str(), "interrupted");
  EXPECT_EQ(asked, 51);  // and not again
  ASSERT_EQ(part.samples.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(part.samples[i].h_e, whole.samples[i].h_e) << i;
  EXPECT_FALSE(part.summary.held);
  EXPECT_NE(part.summary.missed, "");
  asked = 50;  // before the first period
  const TankRun none = run(problem, row, 0, options);
  EXPECT_EQ(none.status, Status::kBudgetExhausted);
  EXPECT_TRUE(none.samples.empty());
  EXPECT_FALSE(none.summary.held);
}

TEST(Tank, AnIntegratorThatFailsEndsItWithItsReason) {
  const Problem problem = load_problem("uvms/valve");
  TankOptions options;
  options.integrator.max_steps = 1;
  const TankRun tank = run(problem, planned(problem, Wrench::kPure, kDefault), 0, options);
  EXPECT_EQ(tank.status, Status::kBudgetExhausted);
  EXPECT_THAT(tank.reason.str(), testing::HasSubstr("cvode: CV_TOO_MUCH_WORK"));
  EXPECT_FALSE(tank.summary.held);
  EXPECT_EQ(tank.samples.size(), 1U);
}

}  // namespace
}  // namespace maxwrench
