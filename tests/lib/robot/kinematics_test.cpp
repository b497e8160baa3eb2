#include "lib/robot/kinematics.h"

#include <gtest/gtest.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "lib/robot/chain.h"
#include "tests/support/contacts.h"
#include "tests/support/kdl_chain.h"
#include "tests/support/mechanics.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr double kDifference = 1e-6;

Pose<double> end_effector(const Robot& robot, const Pose<double>& base, const Eigen::VectorXd& q) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  return base * kinematics.end_effector(robot.end_effectors[0]);
}

TEST(Kinematics, JacobianIsTheDerivativeOfTheEndEffectorPose) {
  Random random(1);
  for (int sample = 0; sample < 20; ++sample) {
    const Robot robot = random_problem(random, 5).robot;
    const Pose<double> base{random_rotation(random), random_vector(random)};
    const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(5, [&] { return random.normal(); });
    Kinematics<double> kinematics(robot);
    kinematics.set_joints(q);
    Matrix6Xd J(6, robot.velocities());
    kinematics.jacobian(robot.end_effectors[0], base.R, J);
    for (int i = 0; i < robot.velocities(); ++i) {
      Pose<double> ends[2] = {base, base};
      for (int side = 0; side < 2; ++side) {
        Eigen::VectorXd q_side = q;
        move(robot, i, side ? kDifference : -kDifference, ends[side], q_side);
        ends[side] = end_effector(robot, ends[side], q_side);
      }
      Vector6d twist;
      twist << ends[1].p - ends[0].p, logarithm(ends[1].R * ends[0].R.transpose());
      EXPECT_LT((twist / (2 * kDifference) - J.col(i)).norm(), 1e-8) << "velocity " << i;
    }
  }
}

/// Joint 4 carries the second arm, joint 1 the rest of the first.
TEST(Kinematics, SetsTheLinksOfChangedJointsAlone) {
  Random random(4);
  const Robot robot = with_firm_grasp(random).robot;
  EXPECT_EQ(carried_by(robot, {1}), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(carried_by(robot, {6, 4}), (std::vector<int>{4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(carried_by(robot, {}), std::vector<int>());
  Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(10, [&] { return random.normal(); });
  Kinematics<double> once(robot), again(robot);
  again.set_joints(q);
  for (const int joint : {1, 4, 7}) {
    q[joint] += 0.5;
    once.set_joints(q);
    again.set_joints(q, carried_by(robot, {joint}));
    for (std::size_t link = 0; link < robot.links.size(); ++link) {
      EXPECT_EQ(again.links()[link].p, once.links()[link].p) << link;
      EXPECT_EQ(again.links()[link].R, once.links()[link].R) << link;
    }
  }
}

/// The caller's matrix and vector may be empty, or of another robot.
TEST(Kinematics, SizesWhatItFills) {
  Random random(3);
  const Robot robot = random_problem(random, 4).robot;
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(Eigen::VectorXd::Constant(4, 0.3));
  Matrix6Xd J(6, robot.velocities()), empty;
  Eigen::VectorXd tau_d(robot.velocities()), longer(robot.velocities() + 5);
  kinematics.jacobian(robot.end_effectors[0], Eigen::Matrix3d::Identity(), J);
  kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), tau_d);
  kinematics.jacobian(robot.end_effectors[0], Eigen::Matrix3d::Identity(), empty);
  kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), longer);
  ASSERT_EQ(empty.cols(), J.cols());
  EXPECT_EQ(empty, J);
  ASSERT_EQ(longer.size(), tau_d.size());
  EXPECT_EQ(longer, tau_d);
}

TEST(Kinematics, StaticLoadIsTheDerivativeOfThePotentialEnergy) {
  Random random(2);
  for (int sample = 0; sample < 20; ++sample) {
    Robot robot = random_problem(random, 5).robot;
    robot.trim = {random.uniform(-2, 2), random_vector(random, 0.2)};
    const Pose<double> base{random_rotation(random), random_vector(random)};
    const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(5, [&] { return random.normal(); });
    Kinematics<double> kinematics(robot);
    kinematics.set_joints(q);
    Eigen::VectorXd tau_d(robot.velocities());
    kinematics.gravity_and_buoyancy(base.R, tau_d);
    const Eigen::VectorXd slopes = potential_energy_slopes(robot, base, q, kDifference);
    EXPECT_LT((slopes - tau_d).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(Kinematics, AgreesWithKdlOnTheDryArm) {
  Random random(3);
  for (int sample = 0; sample < 50; ++sample) {
    Robot robot = random_problem(random, 6).robot;
    robot.water_density = 0;
    const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(6, [&] { return random.normal(); });
    Kinematics<double> kinematics(robot);
    kinematics.set_joints(q);
    const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
    Matrix6Xd J(6, robot.velocities());
    kinematics.jacobian(robot.end_effectors[0], upright, J);
    Eigen::VectorXd tau_d(robot.velocities());
    kinematics.gravity_and_buoyancy(upright, tau_d);

    const KDL::Chain chain = kdl_chain(robot);
    KDL::JntArray positions(6);
    positions.data = q;
    KDL::Frame tip;
    KDL::ChainFkSolverPos_recursive(chain).JntToCart(positions, tip);
    KDL::Jacobian jacobian(6);
    KDL::ChainJntToJacSolver(chain).JntToJac(positions, jacobian);
    KDL::JntArray gravity(6);
    KDL::ChainDynParam(chain, KDL::Vector(0, 0, -robot.gravity)).JntToGravity(positions, gravity);

    const Pose<double> pose = kinematics.end_effector(robot.end_effectors[0]);
    for (int r = 0; r < 3; ++r) {
      EXPECT_NEAR(pose.p[r], tip.p[r], 1e-13);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(pose.R(r, c), tip.M(r, c), 1e-13);
    }
    EXPECT_LT((J.rightCols(6) - jacobian.data).norm(), 1e-12);
    EXPECT_LT((tau_d.tail(6) - gravity.data).norm(), 1e-11);
  }
}

TEST(Kinematics, WeightPressesTheBaseDownAndItsThrustersHoldItUp) {
  // One body of 2 kg in air: the actuators must push up with 2 * 9.81 N. Its centre lies 0.1 m
  // ahead, so they must also pitch it nose up, which is a negative torque about y.
  Robot robot;
  robot.base_axes = {0, 1, 2, 3, 4, 5};
  robot.links.resize(1);
  robot.links[0].mass = 2;
  robot.links[0].com = {0.1, 0, 0};
  Kinematics<double> kinematics(robot);
  Eigen::VectorXd tau_d(6);
  kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), tau_d);
  Vector6d expected;
  expected << 0, 0, 19.62, 0, -1.962, 0;
  EXPECT_LT((tau_d - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace maxwrench
