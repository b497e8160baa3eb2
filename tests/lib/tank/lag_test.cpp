#include <gtest/gtest.h>

#include <cmath>

#include "lib/math/random.h"
#include "lib/tank/controller.h"
#include "lib/tank/ode.h"
#include "lib/trajectory/program.h"
#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/strategies.h"
#include "maxwrench/tank.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/tank.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr double kLagOfTank = 0.1;

Problem lagged_task(const std::string& name, double lag = kLagOfTank) {
  Problem problem = load_problem(name);
  problem.motion->thruster_lag = lag;
  return problem;
}

/// T over the time between instants for thrusters, none for joints: 2.5 s / (4 * 16).
TEST(PlannedLag, ThrustersHaveALagAndJointsHaveNone) {
  const Problem problem = lagged_task("uvms/valve_impulse");
  const auto scenarios = motion_scenarios(problem, Wrench::kPure);
  const SchemeMaps maps = make_scheme(*problem.motion);
  const TrajectoryProgram program =
      make_trajectory_program(problem, *problem.motion, scenarios, maps);
  ASSERT_EQ(program.lag.cols(), program.size() - 1);
  EXPECT_LT((program.lag.topRows(8).array() - 0.1 / (2.5 / 64)).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(program.lag.bottomRows(4).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(
      make_trajectory_program(problem, *load_problem("uvms/valve_impulse").motion, scenarios, maps)
          .lag.size(),
      0);
}

/// From no efforts, the first command is (1 + lag) u_1.
TEST(PlannedLag, AStartWithoutEffortsLimitsTheFirstCommand) {
  Problem problem = lagged_task("uvms/valve_impulse");
  problem.motion->start = Start::kZero;
  problem.motion->rates = false;
  const TrajectoryProgram program =
      make_trajectory_program(problem, *problem.motion, motion_scenarios(problem, Wrench::kPure),
                              make_scheme(*problem.motion));
  const double share = 1 / (1 + 0.1 / (2.5 / 64));
  const Zonotope& set = problem.robot.actuation;
  EXPECT_LT((program.first_max - share * set.u_max).head(8).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((program.first_min - share * set.u_min).head(8).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(program.first_max.tail(4), set.u_max.tail(4));
}

/// The commands of the efforts between instants, u + T du/dt, are within the limits; the value is
/// less than without lag and not less than that of a longer one.
TEST(PlannedLag, CommandsOfATrajectoryAreWithinTheLimits) {
  double before = kInfinity;
  for (const double lag : {0.0, 0.05, 0.1, 0.3}) {
    const Problem problem = lagged_task("uvms/valve_impulse", lag);
    const TrajectorySolverEntry& lp = trajectory_solvers().front();
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, lp.make);
    const Eigen::MatrixXd knots = load_knots(
        MAXWRENCH_SOURCE_DIR "/results/trajectories/uvms_valve_impulse_spline.csv", problem);
    const Trajectory& trajectory = evaluator.evaluate(knots);
    ASSERT_EQ(trajectory.status, Status::kOptimal) << trajectory.reason.c_str();
    EXPECT_LE(trajectory.value, before + 1e-9);
    before = trajectory.value;
    const Zonotope& set = problem.robot.actuation;
    for (std::size_t i = 0; i + 1 < trajectory.instants.size(); ++i) {
      const Instant &a = trajectory.instants[i], &b = trajectory.instants[i + 1];
      const Eigen::VectorXd slope = (b.u - a.u) / (b.t - a.t);
      for (const Eigen::VectorXd& u : {a.u, b.u}) {
        const Eigen::VectorXd command = (u + lag * slope).head(8);
        EXPECT_LT((command - set.u_max.head(8)).maxCoeff(), 1e-6);
        EXPECT_LT((set.u_min.head(8) - command).maxCoeff(), 1e-6);
      }
    }
  }
  EXPECT_LT(before, 39.8);  // the plan without lag is worth 39.88
}

/// The largest request of one period, u_1, leads to a command at the limit; the simulated thruster
/// is then at u_1.
TEST(InvertedLag, AnEffortAtItsBoundIsReached) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator model(problem);
  const Posture posture = model.evaluate(problem.theta_r_default);
  TankOptions options;
  options.invert_lag = true;
  PostureController controller(problem, posture, Wrench::kPure, options);
  const Motion motion{posture.base, posture.q, Eigen::VectorXd::Zero(problem.robot.velocities())};
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.robot.actuators());
  EffortRequest request;
  controller.request(motion, Vector6d::Zero(), u, u, options.period, request);
  // From u = 0: u_max/(1 + 0.1/0.01).
  const Zonotope& set = problem.robot.actuation;
  for (int j = 0; j < 8; ++j) {
    const double rate = options.period * problem.robot.u_rate_max[j];
    EXPECT_NEAR(request.upper[j], std::min(rate, set.u_max[j] / 11), 1e-12);
    EXPECT_NEAR(request.lower[j], std::max(-rate, set.u_min[j] / 11), 1e-12);
  }
  TankOde ode(problem, posture, options);
  ode.start(motion, u);
  ode.command(0, u, options.period, request.upper, Vector6d::Zero(), Vector6d::Zero());
  OdeSolution path;
  find_integrator("cvode").make()->integrate(ode, options.integrator,
                                             std::array{0.0, options.period}, path);
  ASSERT_EQ(path.status, Status::kReached);
  EXPECT_LT((path.y.back().tail(8) - request.upper.head(8)).cwiseAbs().maxCoeff(), 1e-5);
}

/// d F/d y + alpha d F/d y' by differences. What is left out is small beside alpha M, D and K. The
/// base cannot move along axes that it does not have.
TEST(TankOde, TheJacobianOfTheResidualHasTheStiffTerms) {
  for (const char* name : {"uvms/valve", "mobile/push", "planar/force"}) {
    const Problem problem = load_problem(name);
    PostureEvaluator model(problem);
    const Posture posture = model.evaluate(problem.theta_r_default);
    ASSERT_EQ(posture.status, Status::kValid);
    const TankOptions options;
    TankOde ode(problem, posture, options);
    Random random(3);
    Motion motion{posture.base, posture.q, Eigen::VectorXd::Zero(problem.robot.velocities())};
    for (double& rate : motion.v) rate = 1e-2 * random.normal();
    const Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.robot.actuators());
    ode.start(motion, u);
    ode.command(0, u, 0.01, u, Vector6d::Zero(), Vector6d::Zero());
    const Eigen::VectorXd y = ode.initial();
    Eigen::VectorXd y_dot(y.size()), F_0(y.size()), F_1(y.size());
    ASSERT_TRUE(ode.derivative(0.005, y, y_dot));
    const double alpha = 500;
    Eigen::MatrixXd dF;
    ASSERT_TRUE(ode.residual_jacobian(0.005, y, y_dot, alpha, dF));
    Eigen::MatrixXd slopes;
    configuration_slopes(problem.robot, motion, y, slopes);
    const double h = 1e-6;
    double most = 0;
    for (Eigen::Index j = 0; j < y.size(); ++j) {
      if (j < slopes.rows() && slopes.row(j).isZero(0)) continue;
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(y.size(), j);
      ASSERT_TRUE(ode.residual(0.005, y + step, y_dot + alpha * step, F_1));
      ASSERT_TRUE(ode.residual(0.005, y - step, y_dot - alpha * step, F_0));
      const Eigen::VectorXd column = (F_1 - F_0) / (2 * h);
      most = std::max(most, (column - dF.col(j)).norm() / column.norm());
    }
    EXPECT_LT(most, 0.05) << name;
  }
}

TEST(TankOptions, RejectsAPlannedLagThatIsNone) {
  ScriptOptions options;
  for (const double wrong : {-0.1, std::nan(""), kInfinity}) {
    options.thruster_lag = wrong;
    EXPECT_THROW(check(options), std::invalid_argument);
  }
}

}  // namespace
}  // namespace maxwrench
