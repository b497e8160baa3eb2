#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/tank.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

/// A fixed arm in the plane y = 0, all joints about y, nothing redundant: joint 1 at (0, 0), joint
/// 2 at (1, 0), joint 3 at (1.5, 0.5), the end effector at (1.6, 0.3) in x and z, c upwards. All
/// mass is in the joints' axes, so the weight of link 3 has no lever at joint 3, which is the weak
/// one: 1 N m at a lever of 0.1 m allow 10 N along c.
///
/// Efforts that only lack t N m in joint 3 leave out a wrench without moment about joints 1 and 2:
/// a force along x through both. Its moment about joint 3 is t = 0.5 m times the force, so the cell
/// misses 2 t along x, 0.3 m below the end effector, and reads c exactly.
Problem weak_wrist() {
  Problem problem;
  problem.name = "weak wrist";
  Robot& robot = problem.robot;
  const Eigen::Vector3d places[] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0.5}};
  const double efforts[] = {1000, 1000, 1};
  robot.links.resize(4);
  for (int i = 0; i < 3; ++i) {
    Joint joint;
    joint.name = std::string("joint_") + std::to_string(i + 1);
    joint.parent = i;
    joint.placement.p = places[i];
    joint.axis = Eigen::Vector3d::UnitY();
    joint.effort_max = efforts[i];
    joint.q_min = -0.5;  // the elbow bends to one side only
    joint.q_max = 0.5;
    robot.joints.push_back(joint);
    add_body(robot.links[static_cast<std::size_t>(i) + 1], 0.1, Eigen::Vector3d::Zero(),
             0.01 * Eigen::Matrix3d::Identity());
  }
  EndEffector tool;
  tool.link = 3;
  tool.placement.p = {0.1, 0, -0.2};
  robot.end_effectors.push_back(tool);
  complete_actuation(robot);
  problem.pose.p = {1.6, 0, 0.3};
  problem.c = Vector6d::Unit(2);
  problem.W_any = Matrix6Xd::Zero(6, 3);
  problem.W_any(0, 0) = problem.W_any(2, 1) = problem.W_any(4, 2) = 1;
  problem.dependent = {0, 1, 2};
  problem.guess_q = Eigen::Vector3d::Zero();
  return problem;
}

struct ContactArm {
  Problem problem = weak_wrist();
  Posture posture;
  Capability capability;

  ContactArm() {
    PostureEvaluator model(problem);
    posture = model.evaluate(Eigen::VectorXd(0));
    WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
    set_posture(posture, program);
    make_linf_polytope(problem.robot, find_wrench_solver("simplex").make())
        ->evaluate(posture, program, true, capability);
  }

  TankSummary experiment(double planned, const TankOptions& options,
                         Wrench wrench = Wrench::kPure) const {
    const TargetWrench trajectory{planned * problem.c, planned / capability.beta * capability.u,
                                  wrench};
    const TankRun run =
        run_tank(problem, posture, trajectory, *find_integrator("cvode").make(), options);
    EXPECT_EQ(run.status, Status::kReached) << run.reason.c_str();
    return run.summary;
  }
};

TankOptions brief() {
  TankOptions options;
  options.ramp = 2;
  options.hold = 1;
  options.until_hold = true;
  return options;
}

TEST(TankHeld, TheTrajectoryAtTheCapability) {
  const ContactArm arm;
  ASSERT_EQ(arm.posture.status, Status::kValid) << arm.posture.reason.c_str();
  ASSERT_NEAR(arm.capability.beta, 10, 1e-9);
  const TankSummary held = arm.experiment(10, brief());
  EXPECT_TRUE(held.held);
  EXPECT_EQ(held.missed, "");
  EXPECT_LT(held.across.norm(), 1e-3);
}

/// 11 N ask for 0.995 · 11 N · 0.1 m of joint 3, 0.0945 N m too much. c reads well; across it the
/// cell misses 0.189 N, and 0.3 m · 0.189 N = 0.0567 N m. 2 % of 11 N at 0.1 m are 0.022 N m.
TEST(TankHeld, NotWhatTheCellTakesAcrossC) {
  const ContactArm arm;
  const TankSummary beyond = arm.experiment(11, brief());
  EXPECT_NEAR(beyond.mean, 0.995 * 11, 0.02);
  EXPECT_NEAR(std::abs(beyond.across[0]), 0.189, 0.005);
  EXPECT_NEAR(std::abs(beyond.across[4]), 0.0567, 0.002);
  EXPECT_LT(beyond.configuration_error, kHeldThetaRError);
  EXPECT_FALSE(beyond.held);
  EXPECT_THAT(beyond.missed, testing::StartsWith("torque across c 0.05"));
  EXPECT_THAT(beyond.missed, testing::EndsWith(", at most 0.022"));
}

/// If the task leaves the other components to the cell, the same reading is as good as any.
TEST(TankHeld, WhateverAnyWrenchAllows) {
  const ContactArm arm;
  const TankSummary any = arm.experiment(11, brief(), Wrench::kAny);
  EXPECT_NEAR(any.mean, 0.995 * 11, 0.02);
  EXPECT_TRUE(any.held);
}

/// 10 N of weight are carried. 10.4 N are too much for joint 3 by 0.04 N m: as it gives, the lever
/// shrinks by 0.2 m for each radian until 0.02 rad later it is 0.1 m / 1.04, and the load hangs 2
/// mm lower, as still as one that is held.
TEST(TankHeld, ALoadThatTheArmGivesWayTo) {
  const ContactArm arm;
  TankOptions options = brief();
  options.hold = 4;
  const auto carried = [&](double weight) {
    options.load = weight / arm.problem.robot.gravity;
    return arm.experiment(weight, options);
  };
  EXPECT_TRUE(carried(10).held);
  const TankSummary given = carried(10.4);
  EXPECT_LT(given.position_error, kHeldPosition);
  EXPECT_GT(given.configuration_error, 0.02);
  EXPECT_LT(given.configuration_error, 0.04);
  EXPECT_FALSE(given.held);
  EXPECT_THAT(given.missed, testing::HasSubstr("posture off by 0.0"));
}

}  // namespace
}  // namespace maxwrench
