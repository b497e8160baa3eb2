#include "lib/robot/free_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "tests/support/mechanics.h"

// Motions of the free underwater vehicle, alone and with its arm, by every integrator.

namespace maxwrench {
namespace {

using Eigen::VectorXd;

constexpr double kSeconds = 1;

/// Moving, under forces that swing.
struct Swing {
  Robot robot = load_problem("uvms/valve").robot;
  Motion start;

  Swing() {
    const Problem problem = load_problem("uvms/valve");
    PostureEvaluator model(problem);
    const Posture& posture = model.evaluate(problem.theta_r_default);
    start = {posture.base, posture.q, VectorXd::Constant(robot.velocities(), 0.1)};
  }

  /// Without its arm.
  static Swing alone() {
    Swing swing;
    swing.robot.joints.clear();
    swing.robot.links.resize(1);
    swing.robot.end_effectors.clear();
    complete_actuation(swing.robot);
    swing.start.q.resize(0);
    swing.start.v = VectorXd::Constant(6, 0.1);
    return swing;
  }

  static void tau(double t, VectorXd& tau) {
    for (Eigen::Index i = 0; i < tau.size(); ++i) {
      const double size = i < 3 ? 20 : i < 6 ? 2 : 0.0005;
      tau[i] = size * std::sin(3 * t + static_cast<double>(i));
    }
  }

  FreeMotion ode() const { return {robot, start, tau}; }

  static VectorXd end(Ode& motion, const char* integrator, const IntegratorOptions& options) {
    OdeSolution trajectory;
    const Status status = find_integrator(integrator)
                              .make()
                              ->integrate(motion, options, std::array{0.0, kSeconds}, trajectory);
    EXPECT_EQ(status, Status::kReached) << integrator << ": " << trajectory.reason.c_str();
    return trajectory.y.back();
  }
  VectorXd end(const char* integrator, const IntegratorOptions& options) const {
    FreeMotion motion = ode();
    return end(motion, integrator, options);
  }
};

IntegratorOptions fixed_step(double step) {
  IntegratorOptions options;
  options.step = step;
  options.max_steps = 1000000;
  return options;
}

IntegratorOptions within(double tolerance) {
  IntegratorOptions options;
  options.relative_tolerance = options.absolute_tolerance = tolerance;
  options.max_steps = 1000000;
  return options;
}

/// The same problem from another start.
class From final : public Ode {
 public:
  From(Ode& ode, VectorXd start) : ode_(ode), start_(std::move(start)) {}
  const VectorXd& initial() const override { return start_; }
  bool derivative(double t, const VectorXd& y, VectorXd& y_dot) override {
    return ode_.derivative(t, y, y_dot);
  }

 private:
  Ode& ode_;
  VectorXd start_;
};

/// The largest factor by which an error in one component of the start grows until the end.
double amplification(const Swing& swing) {
  constexpr double kStep = 1e-6;
  FreeMotion motion = swing.ode();
  const VectorXd start = motion.initial();
  double worst = 0;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const VectorXd step = kStep * VectorXd::Unit(start.size(), i);
    From above(motion, start + step), below(motion, start - step);
    const VectorXd change = Swing::end(above, "runge_kutta", fixed_step(4e-3)) -
                            Swing::end(below, "runge_kutta", fixed_step(4e-3));
    worst = std::max(worst, change.lpNorm<Eigen::Infinity>() / (2 * kStep));
  }
  return worst;
}

/// A tolerance is that of one step: errors of all steps add up, each grown by what the motion does
/// to it. The vehicle alone forgets them, so that ten (at 1e-8, with more steps, a hundred)
/// tolerances remain.
TEST(MotionIntegration, AllIntegratorsAgreeOnTheVehicle) {
  const Swing swing = Swing::alone();
  EXPECT_LT(amplification(swing), 2);
  const VectorXd reference = swing.end("runge_kutta", fixed_step(5e-4));
  EXPECT_GT((reference.head<3>() - swing.start.base.p).norm(), 0.1);
  for (const IntegratorEntry& entry : integrators()) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const double error =
          (swing.end(entry.name, within(tolerance)) - reference).lpNorm<Eigen::Infinity>();
      EXPECT_LT(error, (tolerance > 1e-7 ? 10 : 100) * tolerance) << entry.name << tolerance;
    }
  }
}

/// Its light arm, free to swing, makes about a hundred times more of every error, which is the same
/// for all integrators; fifty steps' worth of it remain.
TEST(MotionIntegration, SLOW_AllIntegratorsAgreeOnTheVehicleWithItsArm) {
  const Swing swing;
  const double grown = amplification(swing);
  EXPECT_GT(grown, 20);
  EXPECT_LT(grown, 500);
  const VectorXd reference = swing.end("runge_kutta", fixed_step(5e-4));
  for (const IntegratorEntry& entry : integrators()) {
    for (const double tolerance : {1e-5, 1e-7}) {
      const double error =
          (swing.end(entry.name, within(tolerance)) - reference).lpNorm<Eigen::Infinity>();
      EXPECT_LT(error, 50 * grown * tolerance) << entry.name << tolerance;
    }
  }
}

/// The motion, and as one more component the work of tau less that of the drag [J], the latter by
/// an independent route.
class WithWork final : public Ode {
 public:
  explicit WithWork(const Swing& swing)
      : swing_(swing), motion_(swing.ode()), m_(swing.start), start_(motion_.initial().size() + 1) {
    start_ << motion_.initial(), 0;
  }
  const VectorXd& initial() const override { return start_; }
  bool derivative(double t, const VectorXd& y, VectorXd& y_dot) override {
    VectorXd tau(swing_.robot.velocities());
    Swing::tau(t, tau);
    read_motion(y, m_);
    if (!motion_.derivative(t, y.head(y.size() - 1), inner_)) return false;
    y_dot.resize(y.size());
    y_dot << inner_, tau.dot(m_.v) - drag_power(swing_.robot, m_.q, m_.v, m_.v);
    return true;
  }
  double energy(const VectorXd& y) {
    read_motion(y, m_);
    return kinetic_energy(swing_.robot, m_.q, m_.v) + potential_energy(swing_.robot, m_.base, m_.q);
  }

 private:
  const Swing& swing_;
  FreeMotion motion_;
  Motion m_;
  VectorXd start_, inner_;
};

/// T + V grows by that work. What is missing shrinks with the tolerance.
TEST(MotionIntegration, PowerBalancesToTheTolerance) {
  const Swing swing;
  for (const char* name : {"cvode", "cvode_adams", "arkode"}) {
    for (const double tolerance : {1e-6, 1e-9}) {
      WithWork motion(swing);
      const VectorXd end = Swing::end(motion, name, within(tolerance));
      const double before = motion.energy(motion.initial()), after = motion.energy(end);
      const double work = end[end.size() - 1];
      EXPECT_GT(std::abs(work), 0.1);
      EXPECT_LT(std::abs(after - before - work), 300 * tolerance) << name << tolerance;
    }
  }
}

/// Without the quadratic drag: where |v| v passes zero its second derivative jumps, and the order
/// of a step across is lower.
TEST(MotionIntegration, SLOW_RungeKuttaConvergesWithOrderFour) {
  Swing swing;
  for (Link& link : swing.robot.links) {
    for (HydrodynamicBody& body : link.hydrodynamics) body.damping_quadratic.setZero();
  }
  const VectorXd reference = swing.end("runge_kutta", fixed_step(2.5e-4));
  double before = 0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    const double error = (swing.end("runge_kutta", fixed_step(step)) - reference).norm();
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 4, 0.15) << step;
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
