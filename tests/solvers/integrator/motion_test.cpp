#include "lib/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/random.h"
#include "problems/loader.h"
#include "solvers/strategies.h"

// One motion of the free underwater vehicle with its arm, by every integrator.

namespace maxwrench {
namespace {

using Eigen::VectorXd;

constexpr double kSeconds = 1;

/// The default posture of the valve task, moving, under forces that swing.
struct Swing {
  Problem problem = load_problem("uvms/valve");
  Motion start;

  Swing() {
    PostureModel model(problem);
    const Posture& posture = model.evaluate(problem.theta_r_default);
    Random random(7);
    start = {posture.base, posture.q, VectorXd::NullaryExpr(problem.robot.velocities(), [&] {
               return 0.1 + 0.05 * random.uniform();
             })};
  }

  FreeMotion ode() const {
    return {problem.robot, start, [](double t, VectorXd& tau) {
              for (Eigen::Index i = 0; i < tau.size(); ++i) {
                const double size = i < 3 ? 20 : i < 6 ? 2 : 0.0005;
                tau[i] = size * std::sin(3 * t + static_cast<double>(i));
              }
            }};
  }

  VectorXd end(const char* integrator, const IntegratorOptions& options) const {
    FreeMotion motion = ode();
    Trajectory trajectory;
    const Status status = find_integrator(integrator)
                              .make()
                              ->integrate(motion, options, std::array{0.0, kSeconds}, trajectory);
    EXPECT_EQ(status, Status::kOptimal) << integrator << ": " << trajectory.reason;
    return trajectory.y.back();
  }
};

IntegratorOptions fixed_step(double step) {
  IntegratorOptions options;
  options.step = step;
  options.max_steps = 1000000;
  return options;
}

TEST(MotionIntegration, AllIntegratorsAgreeWithinTheirTolerances) {
  const Swing swing;
  const VectorXd reference = swing.end("runge_kutta", fixed_step(1e-4));
  EXPECT_GT((reference.head<3>() - swing.start.base.p).norm(), 0.1);
  for (const IntegratorEntry& entry : integrators()) {
    for (const double tolerance : {1e-6, 1e-9}) {
      IntegratorOptions options;
      options.relative_tolerance = options.absolute_tolerance = tolerance;
      options.max_steps = 1000000;
      const double error = (swing.end(entry.name, options) - reference).lpNorm<Eigen::Infinity>();
      // The tolerance is that of one step; the light arm swings freely and amplifies errors. What
      // counts is that all shrink with it.
      EXPECT_LT(error, 3000 * tolerance) << entry.name << " at " << tolerance;
    }
  }
}

TEST(MotionIntegration, RungeKuttaConvergesWithOrderFour) {
  const Swing swing;
  const VectorXd reference = swing.end("runge_kutta", fixed_step(1e-4));
  double before = 0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    const double error = (swing.end("runge_kutta", fixed_step(step)) - reference).norm();
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 4, 0.4) << step;
    }
    before = error;
  }
}

TEST(MotionIntegration, TheQuaternionKeepsItsLength) {
  const Swing swing;
  const VectorXd y = swing.end("runge_kutta", fixed_step(1e-3));
  EXPECT_NEAR(y.segment<4>(3).norm(), 1, 1e-9);
}

/// F = 0 exactly where y' = f.
TEST(MotionIntegration, ResidualVanishesOnTheDerivative) {
  const Swing swing;
  FreeMotion motion = swing.ode();
  VectorXd y_dot, F;
  ASSERT_TRUE(motion.derivative(0.3, motion.initial(), y_dot));
  ASSERT_TRUE(motion.residual(0.3, motion.initial(), y_dot, F));
  EXPECT_LT(F.norm(), 1e-9);
  y_dot.tail<1>()[0] += 1;
  ASSERT_TRUE(motion.residual(0.3, motion.initial(), y_dot, F));
  EXPECT_GT(F.norm(), 1e-6);
}

}  // namespace
}  // namespace maxwrench
