#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "lib/robot/dynamics.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

// Balances along simulated motions: what a wrong Coriolis term breaks although each state looks
// right.

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kJoints = 4;
constexpr int kVelocities = 6 + kJoints;

struct Driven {
  Pose<double> base;
  VectorXd q, v;
  double work = 0;  ///< J, done on the robot by actuators, drag and contact
};

Driven operator+(const Driven& a, const Driven& b) {
  return {{a.base.R + b.base.R, a.base.p + b.base.p}, a.q + b.q, a.v + b.v, a.work + b.work};
}
Driven operator*(double s, const Driven& a) {
  return {{s * a.base.R, s * a.base.p}, s * a.q, s * a.v, s * a.work};
}

/// A robot under actuator forces tau(t) whose end effector exerts h_e.
struct Simulation {
  explicit Simulation(Robot simulated) : robot(std::move(simulated)) {}

  Driven derivative(double t, const Driven& m) {
    dynamics.set_configuration(m.base.R, m.q);
    VectorXd v_d(kVelocities);
    dynamics.forward(m.v, tau(t), tool, h_e, v_d);
    Matrix6Xd J(6, kVelocities);
    dynamics.kinematics().jacobian(tool, m.base.R, J);
    const Vector3d w = m.v.segment<3>(3);
    Eigen::Matrix3d R_d;
    for (int row = 0; row < 3; ++row) R_d.row(row) = Vector3d(m.base.R.row(row)).cross(w);
    const double power = m.v.dot(tau(t)) - h_e.dot(J * m.v) - drag_power(robot, m.q, m.v, m.v);
    return {{R_d, m.base.R * m.v.head<3>()}, m.v.tail(kJoints), v_d, power};
  }

  /// The classical Runge-Kutta method of order four.
  Driven run(Driven m, double seconds, int steps) {
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      const Driven k1 = derivative(t, m);
      const Driven k2 = derivative(t + h / 2, m + h / 2 * k1);
      const Driven k3 = derivative(t + h / 2, m + h / 2 * k2);
      const Driven k4 = derivative(t + h, m + h * k3);
      m = m + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return m;
  }

  double energy(const Driven& m) const {
    return kinetic_energy(robot, m.q, m.v) + potential_energy(robot, m.base, m.q);
  }

  const Robot robot;
  EndEffector tool = robot.end_effectors[0];
  std::function<VectorXd(double)> tau;
  Vector6d h_e = Vector6d::Zero();
  Dynamics dynamics{robot};
};

Driven random_motion(Random& random) {
  return {{random_rotation(random), random_vector(random)},
          random_numbers(random, kJoints),
          random_numbers(random, kVelocities)};
}

/// T + V grows by the work of actuators, less that of drag and contact. Halving the step divides
/// what is missing by about 16, so it is the integrator's.
TEST(DynamicsMotion, EnergyGrowsByTheWorkDone) {
  Random random(31);
  for (int sample = 0; sample < samples(5); ++sample) {
    Simulation simulation(random_wet_robot(random, kJoints));
    const VectorXd amplitude =
        VectorXd::NullaryExpr(kVelocities, [&] { return 2 * random.normal(); });
    simulation.tau = [amplitude](double t) -> VectorXd { return std::cos(3 * t) * amplitude; };
    simulation.h_e = Vector6d::NullaryExpr([&] { return random.normal(); });
    const Driven start = random_motion(random);
    double missing[2] = {};
    for (const int half : {0, 1}) {
      const Driven end = simulation.run(start, 0.5, half ? 1000 : 500);
      missing[half] = std::abs(simulation.energy(end) - simulation.energy(start) - end.work);
      EXPECT_GT((end.v - start.v).norm(), 0.1);
    }
    EXPECT_LT(missing[1], 1e-7 * std::abs(simulation.energy(start)));
    EXPECT_LT(missing[1], missing[0] / 8 + 1e-10);
  }
}

/// Weightless and without drag, the momentum of robot and moved water, in world axes about the
/// world's origin, keeps its value whatever the joints do.
TEST(DynamicsMotion, JointForcesLeaveTheMomentumAsItIs) {
  Random random(32);
  for (int sample = 0; sample < samples(5); ++sample) {
    Robot robot = random_wet_robot(random, kJoints);
    robot.gravity = 0;
    for (Link& link : robot.links) {
      for (HydrodynamicBody& body : link.hydrodynamics) {
        body.damping_linear.setZero();
        body.damping_quadratic.setZero();
      }
    }
    Simulation simulation(robot);
    VectorXd amplitude = VectorXd::Zero(kVelocities);
    for (int i = 6; i < kVelocities; ++i) amplitude[i] = 2 * random.normal();
    simulation.tau = [amplitude](double t) -> VectorXd { return std::cos(3 * t) * amplitude; };
    const auto momentum = [&simulation](const Driven& m) -> Vector6d {
      Eigen::MatrixXd M;
      simulation.dynamics.set_configuration(m.base.R, m.q);
      simulation.dynamics.mass_matrix(M);
      const VectorXd p = M * m.v;
      const Vector3d linear = m.base.R * p.head<3>();
      Vector6d result;
      result << linear, m.base.R * p.segment<3>(3) + m.base.p.cross(linear);
      return result;
    };
    const Driven start = random_motion(random);
    const Driven end = simulation.run(start, 0.5, 1000);
    EXPECT_GT((end.v - start.v).norm(), 0.1);
    EXPECT_LT((momentum(end) - momentum(start)).norm(), 1e-8 * momentum(start).norm());
  }
}

}  // namespace
}  // namespace maxwrench
