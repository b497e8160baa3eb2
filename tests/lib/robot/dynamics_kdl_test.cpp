#include <gtest/gtest.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "lib/robot/dynamics.h"
#include "tests/support/kdl_chain.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

// An independent code for the dry robot: Orocos KDL.

namespace maxwrench {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kChainJoints = 6;

/// A chain without water.
Robot random_dry_chain(Random& random) {
  Robot robot = random_dry_robot(random, kChainJoints);
  for (int i = 0; i < kChainJoints; ++i) robot.joints[i].parent = i;
  return robot;
}

/// What KDL says about one motion of a chain.
struct Kdl {
  Kdl(const KDL::Chain& chain, double gravity, const VectorXd& q, const VectorXd& q_d,
      const VectorXd& q_dd)
      : M(q.size(), q.size()), coriolis(q.size()), tau(q.size()) {
    const auto n = static_cast<unsigned>(q.size());
    KDL::JntArray position(n), rate(n), acceleration(n), torques(n), products(n);
    position.data = q;
    rate.data = q_d;
    acceleration.data = q_dd;
    const KDL::Vector down(0, 0, -gravity);
    KDL::JntSpaceInertiaMatrix inertia(n);
    KDL::ChainDynParam parameters(chain, down);
    EXPECT_EQ(parameters.JntToMass(position, inertia), 0);
    EXPECT_EQ(parameters.JntToCoriolis(position, rate, products), 0);
    KDL::ChainIdSolver_RNE solver(chain, down);
    const KDL::Wrenches none(chain.getNrOfSegments(), KDL::Wrench::Zero());
    EXPECT_EQ(solver.CartToJnt(position, rate, acceleration, none, torques), 0);
    M = inertia.data;
    coriolis = products.data;
    tau = torques.data;
  }

  MatrixXd M;
  VectorXd coriolis, tau;
};

void expect_same(const MatrixXd& ours, const MatrixXd& kdl) {
  EXPECT_LT((ours - kdl).cwiseAbs().maxCoeff(), 1e-12 * kdl.cwiseAbs().maxCoeff());
}

TEST(DynamicsKdl, ArmOnAFixedBase) {
  Random random(21);
  for (int sample = 0; sample < 100; ++sample) {
    Robot robot = random_dry_chain(random);
    robot.base_axes = {};
    const VectorXd q = random_numbers(random, kChainJoints),
                   v = random_numbers(random, kChainJoints),
                   v_d = random_numbers(random, kChainJoints);
    const Kdl kdl(kdl_chain(robot), robot.gravity, q, v, v_d);
    Dynamics dynamics(robot);
    dynamics.set_configuration(Matrix3d::Identity(), q);
    MatrixXd M;
    VectorXd C_v(kChainJoints), tau_d(kChainJoints);
    dynamics.mass_matrix(M);
    dynamics.coriolis(v, C_v);
    dynamics.inverse(v, v_d, tau_d);
    expect_same(M, kdl.M);
    expect_same(C_v, kdl.coriolis);
    expect_same(tau_d, kdl.tau);
  }
}

/// Six joints in place of the base: position p in the world, then yaw, pitch, roll. Our velocities
/// are v = G y_d with y = (p, yaw, pitch, roll, q):
///   linear R'p_d, angular x roll_d + Rx'y pitch_d + Rx'Ry'z yaw_d = E (yaw_d, pitch_d, roll_d).
struct BaseJoints {
  explicit BaseJoints(const Vector3d& angles) {
    using Eigen::AngleAxisd;
    const Matrix3d Rz = AngleAxisd(angles[0], Vector3d::UnitZ()).toRotationMatrix();
    const Matrix3d Ry = AngleAxisd(angles[1], Vector3d::UnitY()).toRotationMatrix();
    const Matrix3d Rx = AngleAxisd(angles[2], Vector3d::UnitX()).toRotationMatrix();
    R = Rz * Ry * Rx;
    E.col(0) = Rx.transpose() * Ry.transpose() * Vector3d::UnitZ();
    E.col(1) = Rx.transpose() * Vector3d::UnitY();
    E.col(2) = Vector3d::UnitX();
  }

  MatrixXd G() const {
    MatrixXd result = MatrixXd::Identity(6 + kChainJoints, 6 + kChainJoints);
    result.topLeftCorner<3, 3>() = R.transpose();
    result.block<3, 3>(3, 3) = E;
    return result;
  }

  /// G_d y_d: in body axes a vector that rests in the world turns with -w, the axis of yaw, which
  /// rests, and the axis of pitch with what comes after it.
  VectorXd G_d_y_d(const VectorXd& y_d) const {
    const Vector3d rates = y_d.segment<3>(3), w = E * rates;
    VectorXd result = VectorXd::Zero(y_d.size());
    result.head<3>() = -w.cross(R.transpose() * y_d.head<3>());
    result.segment<3>(3) =
        -w.cross(E.col(0)) * rates[0] - (E.col(2) * rates[2]).cross(E.col(1)) * rates[1];
    return result;
  }

  Matrix3d R, E;
};

TEST(DynamicsKdl, ArmOnAFloatingBase) {
  Random random(22);
  const int n = 6 + kChainJoints;
  for (int sample = 0; sample < 100; ++sample) {
    const Robot robot = random_dry_chain(random);
    const VectorXd y = random_numbers(random, n), y_d = random_numbers(random, n),
                   y_dd = random_numbers(random, n);
    const Kdl kdl(floating_kdl_chain(robot), robot.gravity, y, y_d, y_dd);
    const BaseJoints base(y.segment<3>(3));
    const MatrixXd G = base.G();
    const VectorXd G_d_y_d = base.G_d_y_d(y_d);
    Dynamics dynamics(robot);
    dynamics.set_configuration(base.R, y.tail<kChainJoints>());
    MatrixXd M;
    VectorXd C_v(n), tau_d(n);
    dynamics.mass_matrix(M);
    dynamics.coriolis(G * y_d, C_v);
    dynamics.inverse(G * y_d, G * y_dd + G_d_y_d, tau_d);
    // The power is the same in both: tau'v = (G'tau)'y_d.
    expect_same(G.transpose() * M * G, kdl.M);
    expect_same(G.transpose() * (M * G_d_y_d + C_v), kdl.coriolis);
    expect_same(G.transpose() * tau_d, kdl.tau);
  }
}

}  // namespace
}  // namespace maxwrench
