#include "lib/robot/dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/math/decompositions.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A random wet robot at a random configuration.
struct Sample {
  explicit Sample(Random& random, int joints = 5)
      : robot(random_wet_robot(random, joints)),
        n(robot.velocities()),
        R_base(random_rotation(random)),
        q(random_numbers(random, joints)),
        v(random_numbers(random, n)),
        v_d(random_numbers(random, n)),
        dynamics(robot) {
    dynamics.set_configuration(R_base, q);
  }

  const Robot robot;
  const int n;
  const Eigen::Matrix3d R_base;
  const VectorXd q, v, v_d;
  Dynamics dynamics;
};

double relative(const MatrixXd& ours, const MatrixXd& expected) {
  return (ours - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

TEST(Dynamics, AtRestTheLoadIsGravityAndBuoyancyToTheLastBit) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    Sample s(random);
    Kinematics<double> kinematics(s.robot);
    kinematics.set_joints(s.q);
    VectorXd expected(s.n), tau_d(s.n);
    kinematics.gravity_and_buoyancy(s.R_base, expected);
    s.dynamics.inverse(VectorXd::Zero(s.n), VectorXd::Zero(s.n), tau_d);
    EXPECT_EQ(tau_d, expected);
  }
}

TEST(Dynamics, LoadIsTheSumOfItsTerms) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    Sample s(random);
    MatrixXd M;
    VectorXd tau_d(s.n), C_v(s.n), D_v(s.n), g(s.n);
    s.dynamics.inverse(s.v, s.v_d, tau_d);
    s.dynamics.mass_matrix(M);
    s.dynamics.coriolis(s.v, C_v);
    s.dynamics.damping(s.v, D_v);
    s.dynamics.gravity(g);
    EXPECT_LT(relative(M * s.v_d + C_v + D_v + g, tau_d), 1e-13);
  }
}

/// The kinetic energy is T = v'M v / 2, so u'M v = T(u + v) - T(u) - T(v) for unit u, v.
TEST(Dynamics, MassMatrixIsTheHessianOfTheKineticEnergyAndPositiveDefinite) {
  Random random(3);
  for (int i = 0; i < std::max(4, samples(20)); ++i) {
    Sample s(random);
    MatrixXd M, hessian(s.n, s.n);
    s.dynamics.mass_matrix(M);
    const auto T = [&s](const VectorXd& v) { return kinetic_energy(s.robot, s.q, v); };
    const MatrixXd unit = MatrixXd::Identity(s.n, s.n);
    for (int r = 0; r < s.n; ++r) {
      for (int c = 0; c < s.n; ++c) {
        hessian(r, c) = T(unit.col(r) + unit.col(c)) - T(unit.col(r)) - T(unit.col(c));
      }
    }
    EXPECT_LT(relative(M, hessian), 1e-13);
    EXPECT_EQ(M, M.transpose());
    EXPECT_GT(symmetric_eigen(M).values[0], 0);
    EXPECT_NEAR(s.v.dot(M * s.v) / 2 / T(s.v), 1, 1e-13);
  }
}

TEST(Dynamics, MassSlopesAreThoseOfTheMassMatrix) {
  Random random(14);
  const double h = 1e-5;
  for (int i = 0; i < 20; ++i) {
    Sample s(random);
    const VectorXd x = random_numbers(random, s.n), y = random_numbers(random, s.n);
    VectorXd slopes;
    s.dynamics.mass_slopes(x, y, slopes);
    ASSERT_EQ(slopes.size(), s.q.size());
    for (Eigen::Index k = 0; k < s.q.size(); ++k) {
      const auto product = [&](double step) {
        MatrixXd M;
        s.dynamics.set_configuration(s.R_base, s.q + step * VectorXd::Unit(s.q.size(), k));
        s.dynamics.mass_matrix(M);
        return x.dot(M * y);
      };
      const double difference = (product(h) - product(-h)) / (2 * h);
      EXPECT_NEAR(slopes[k], difference, 1e-7 * (1 + slopes.norm()));
    }
  }
}

/// Hamel's equations, from the kinetic energy alone: with the momenta p = dT/dv, of the base (P, L)
/// at its twist (V, W), the inertial part of tau_d is
///   P_d + W x P,   L_d + W x L + V x P,   p_d - dT/dq.
/// T does not depend on where the base is. Derivatives by central differences.
TEST(Dynamics, InertialForcesFollowFromTheKineticEnergy) {
  Random random(4);
  const double h = 1e-4;
  for (int i = 0; i < 20; ++i) {
    Sample s(random);
    const auto joints = s.robot.joints.size();
    const auto momentum = [&](double t) -> VectorXd {
      const VectorXd q = s.q + t * s.v.tail(joints) + t * t / 2 * s.v_d.tail(joints);
      MatrixXd M;
      s.dynamics.set_configuration(s.R_base, q);
      s.dynamics.mass_matrix(M);
      return M * (s.v + t * s.v_d);
    };
    const VectorXd p = momentum(0);
    VectorXd expected = (momentum(h) - momentum(-h)) / (2 * h);
    const Eigen::Vector3d V = s.v.head<3>(), W = s.v.segment<3>(3), P = p.head<3>();
    expected.head<3>() += W.cross(P);
    expected.segment<3>(3) += W.cross(p.segment<3>(3)) + V.cross(P);
    for (std::size_t j = 0; j < joints; ++j) {
      const VectorXd step = h * VectorXd::Unit(joints, j);
      expected[6 + j] -=
          (kinetic_energy(s.robot, s.q + step, s.v) - kinetic_energy(s.robot, s.q - step, s.v)) /
          (2 * h);
    }
    MatrixXd M;
    VectorXd C_v(s.n);
    s.dynamics.set_configuration(s.R_base, s.q);
    s.dynamics.mass_matrix(M);
    s.dynamics.coriolis(s.v, C_v);
    EXPECT_LT(relative(M * s.v_d + C_v, expected), 1e-6);
  }
}

TEST(Dynamics, DragIsThatOfEachBody) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    Sample s(random);
    VectorXd D_v(s.n);
    s.dynamics.damping(s.v, D_v);
    for (int k = 0; k < s.n; ++k) {
      EXPECT_NEAR(D_v[k], drag_power(s.robot, s.q, s.v, VectorXd::Unit(s.n, k)),
                  1e-13 * D_v.norm());
    }
  }
}

/// A base on fewer axes does not move along the others, and what they bear is not asked for.
TEST(Dynamics, FewerBaseAxesGiveTheSameRows) {
  const std::vector<std::vector<int>> subsets = {{},  {0},       {0, 1},       {0, 1, 2},
                                                 {5}, {0, 1, 5}, {0, 1, 2, 5}, {0, 1, 2, 3, 4, 5}};
  Random random(6);
  for (const std::vector<int>& axes : subsets) {
    ASSERT_TRUE(base_axes_are_integrable(axes));
    Sample full(random);
    Robot robot = full.robot;
    robot.base_axes = axes;
    const int n = robot.velocities();
    MatrixXd S = MatrixXd::Zero(full.n, n);  // embeds the velocities
    for (int i = 0; i < n; ++i) {
      const int base = static_cast<int>(axes.size());
      S(i < base ? axes[i] : 6 + i - base, i) = 1;
    }
    const VectorXd v = S.transpose() * full.v, v_d = S.transpose() * full.v_d;
    Dynamics dynamics(robot);
    dynamics.set_configuration(full.R_base, full.q);
    VectorXd tau_d(n), tau_full(full.n), back(n);
    MatrixXd M, M_full;
    dynamics.inverse(v, v_d, tau_d);
    full.dynamics.inverse(S * v, S * v_d, tau_full);
    dynamics.mass_matrix(M);
    full.dynamics.mass_matrix(M_full);
    EXPECT_LT(relative(tau_d, S.transpose() * tau_full), 1e-14);
    EXPECT_LT(relative(M, S.transpose() * M_full * S), 1e-14);
    dynamics.forward(v, tau_d, back);
    EXPECT_LT(relative(back, v_d), 1e-10);
  }
}

TEST(Dynamics, ForwardInvertsInverseWithAndWithoutContact) {
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    Sample s(random, 6);
    const EndEffector& tool = s.robot.end_effectors[0];
    VectorXd tau_d(s.n), v_d(s.n);
    s.dynamics.inverse(s.v, s.v_d, tau_d);
    s.dynamics.forward(s.v, tau_d, v_d);
    EXPECT_LT(relative(v_d, s.v_d), 1e-10);
    const Vector6d h_e = random_numbers(random, 6);
    Matrix6Xd J(6, s.n);
    s.dynamics.kinematics().jacobian(tool, s.R_base, J);
    s.dynamics.forward(s.v, tau_d + J.transpose() * h_e, tool, h_e, v_d);
    EXPECT_LT(relative(v_d, s.v_d), 1e-10);
  }
}

TEST(Dynamics, AllocatesNothing) {
  Random random(8);
  Sample s(random);
  VectorXd tau_d(s.n), v_d(s.n);
  MatrixXd M(s.n, s.n);
  const Vector6d h_e = Vector6d::Ones();
  const long before = allocation_count();
  s.dynamics.set_configuration(s.R_base, s.q);
  s.dynamics.inverse(s.v, s.v_d, tau_d);
  s.dynamics.mass_matrix(M);
  s.dynamics.coriolis(s.v, v_d);
  s.dynamics.damping(s.v, v_d);
  s.dynamics.gravity(v_d);
  s.dynamics.forward(s.v, tau_d, s.robot.end_effectors[0], h_e, v_d);
  EXPECT_EQ(allocation_count(), before);
}

/// A sphere of 1 kg that carries 2 kg of water along x, 5 along y: at twist v = (1, 1, 0), w = (0,
/// 0, 1) the momentum is (3, 6, 0) and turns with the body: w x p = (-6, 3, 0); the water's torque
/// about z is v x p = 1 * 6 - 1 * 3 (Munk). Drag 4 v + 7 |v| v along x only: 11.
TEST(Dynamics, OneBodyInWaterByHand) {
  Robot robot;
  robot.base_axes = {0, 1, 2, 3, 4, 5};
  robot.gravity = 0;
  robot.links.resize(1);
  robot.links[0].mass = 1;
  HydrodynamicBody water;
  water.added_mass << 2, 5, 0, 0, 0, 0;
  water.damping_linear[0] = 4;
  water.damping_quadratic[0] = 7;
  robot.links[0].hydrodynamics = {water};
  Dynamics dynamics(robot);
  dynamics.set_configuration(Eigen::Matrix3d::Identity(), VectorXd());
  VectorXd v(6), tau_d(6), expected(6);
  v << 1, 1, 0, 0, 0, 1;
  expected << -6 + 11, 3, 0, 0, 0, 3;
  dynamics.inverse(v, VectorXd::Zero(6), tau_d);
  EXPECT_LT((tau_d - expected).norm(), 1e-15);
  v *= -1;  // the drag changes sign, the rest does not
  expected[0] = -6 - 11;
  dynamics.inverse(v, VectorXd::Zero(6), tau_d);
  EXPECT_LT((tau_d - expected).norm(), 1e-15);
}

}  // namespace
}  // namespace maxwrench
