#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lib/posture/redundancy.h"
#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/bound.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "maxwrench/task.h"
#include "tests/support/support.h"
#include "tests/support/written_urdf.h"

namespace maxwrench::urdf {
namespace {

using testing::HasSubstr;

/// With all digits.
std::string all_digits(double number) { return fmt::format("{:.17g}", number); }

std::string weighty_link(const std::string& name, double mass) {
  const std::string m = all_digits(mass);
  return "<link name='" + name + "'><inertial><origin xyz='0.02 0.01 0.1'/><mass value='" + m +
         "'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>";
}

std::string turned_by(const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& xyz, const std::string& axis, double effort) {
  return "<joint name='" + name + "' type='revolute'><parent link='" + parent + "'/><child link='" +
         child + "'/><origin xyz='" + xyz + "'/><axis xyz='" + axis +
         "'/><limit lower='-3' upper='3' effort='" + all_digits(effort) +
         "' velocity='1'/></joint>";
}

std::string moved_by_slide(const std::string& name, const std::string& parent,
                           const std::string& child, const std::string& axis, double lower,
                           double upper, double effort, const std::string& mimic = "") {
  return "<joint name='" + name + "' type='prismatic'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='0 0 0.1'/><axis xyz='" + axis + "'/>" +
         mimic + "<limit lower='" + all_digits(lower) + "' upper='" + all_digits(upper) +
         "' effort='" + all_digits(effort) + "' velocity='1'/></joint>";
}

/// Six joints with offsets, from a link to `hand`.
std::string six_joints_on(const std::string& link) {
  return weighty_link("a", 2) + weighty_link("b", 2) + weighty_link("c", 1.5) +
         weighty_link("d", 1) + weighty_link("e", 0.5) + weighty_link("hand", 0.3) +
         turned_by("j1", link, "a", "0.1 0 0.2", "0 0 1", 60) +
         turned_by("j2", "a", "b", "0 0.02 0.1", "0 1 0", 60) +
         turned_by("j3", "b", "c", "0 0 0.4", "0 1 0", 40) +
         turned_by("j4", "c", "d", "0.03 0 0.2", "0 0 1", 20) +
         turned_by("j5", "d", "e", "0 0 0.2", "0 1 0", 20) +
         turned_by("j6", "e", "hand", "0 0 0.1", "0 0 1", 10);
}

const std::string kToolOnHand = "end_effectors.tool = { link = 'hand', xyz = [0, 0, 0.1] }\n";

TaskSpec lift_with(const Robot& robot) {
  TaskSpec task;
  task.robot = robot;
  task.end_effector = "tool";
  task.c << 0, 0, 1, 0, 0, 0;
  task.pose.p << 0.45, 0.1, 1.0;
  task.pose.R = Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return task;
}

class GearsInTheChain : public UrdfTest {
 protected:
  /// A column whose second stage goes ratio times as far as its first one, relative to it. The
  /// motor moves the first stage of 4 kg; the second one weighs 3 kg.
  Robot telescope(double ratio, double effort, double offset = 0) {
    return load(weighty_link("base", 5) + weighty_link("low", 4) + weighty_link("high", 3) +
                    six_joints_on("high") +
                    moved_by_slide("low_lift", "base", "low", "0 0 1", -0.2, 0.3, effort) +
                    moved_by_slide("high_lift", "low", "high", "0 0 1", -1, 1, 0,
                                   "<mimic joint='low_lift' multiplier='" + all_digits(ratio) +
                                       "' offset='" + all_digits(offset) + "'/>"),
                kToolOnHand);
  }

  /// What moves as that column's second stage, by one joint s = (1 + ratio) q. By virtual work, a
  /// motor of `effort` at q is one of effort / (1 + ratio) at s, and carries 4 kg / (1 + ratio).
  Robot single(double ratio, double effort) {
    const double all = 1 + ratio;
    return load(
        weighty_link("base", 5) + weighty_link("high", 3 + 4 / all) + six_joints_on("high") +
            "<link name='low'/><joint name='fixed' type='fixed'><parent link='base'/><child "
            "link='low'/><origin xyz='0 0 0.1'/></joint>" +
            moved_by_slide("lift", "low", "high", "0 0 1", -0.2 * all, 0.3 * all, effort / all),
        kToolOnHand);
  }
};

TEST_F(GearsInTheChain, TheLeaderIsRedundantAndTheOtherFollows) {
  const Problem task = make_problem(lift_with(telescope(0.5, 400, 0.04)));
  ASSERT_EQ(task.redundancy(), 1);
  EXPECT_EQ(task.theta_r_name(0), "low_lift");
  EXPECT_EQ(task.dependent.size(), 6U);
  const int high = find_joint(task.robot, "high_lift"), low = find_joint(task.robot, "low_lift");
  PostureEvaluator model(task);
  Random random(1);
  int valid = 0;
  for (int i = 0; i < 50; ++i) {
    const Posture& posture = model.evaluate(random_theta_r(task, random));
    if (posture.status != Status::kValid) continue;
    ++valid;
    EXPECT_NEAR(posture.q[high], 0.5 * posture.q[low] + 0.04, 1e-15);
    const Pose<double> pose = pose_at_mount(task.robot, task.end_effector, posture.q);
    EXPECT_LT((pose.p - task.pose.p).norm(), 1e-9);
    EXPECT_LT((pose.R - task.pose.R).norm(), 1e-9);
    // The null motion keeps the pose, and the gear.
    Eigen::MatrixXd A_r;
    null_motion(task, posture, A_r);
    EXPECT_LT((posture.J * A_r).norm(), 1e-9);
    EXPECT_NEAR(A_r(high, 0), 0.5 * A_r(low, 0), 1e-12);
  }
  EXPECT_GT(valid, 10);
}

/// The load of the second stage is reflected to the motor: the same robot with one joint in place
/// of the column has the same values, gradients and optimum.
TEST_F(GearsInTheChain, SLOW_ATelescopeIsAsStrongAsOneJointInItsPlace) {
  for (const double ratio : {1.0, 0.5, -0.25}) {
    for (const double effort : {1000.0, 260.0}) {  // the arm decides, or the column
      const Problem geared = make_problem(lift_with(telescope(ratio, effort)));
      const Problem plain = make_problem(lift_with(single(ratio, effort)));
      ASSERT_EQ(geared.redundancy(), 1);
      Options options;
      options.threads = 1;
      options.budget = 500;
      const Answer a = solve(geared, options);
      // The redundant joint of the plain robot is chosen freely; ask for the same one.
      TaskSpec named = lift_with(plain.robot);
      named.joints = std::vector<std::string>{"lift"};
      const Problem by_lift = make_problem(named);
      const Answer b = solve(by_lift, options);
      ASSERT_EQ(a.status, Status::kBestFound);
      ASSERT_EQ(b.status, Status::kBestFound);
      EXPECT_NEAR(a.beta(), b.beta(), 1e-5 * b.beta()) << ratio << ' ' << effort;
      for (const double q : {-0.15, -0.02, 0.11, 0.26}) {
        const Answer at = evaluate(geared, Eigen::VectorXd::Constant(1, q), options);
        const Answer there =
            evaluate(by_lift, Eigen::VectorXd::Constant(1, (1 + ratio) * q), options);
        ASSERT_EQ(at.posture.status, there.posture.status) << q;
        if (at.posture.status != Status::kValid) continue;
        EXPECT_NEAR(at.beta(), there.beta(), 1e-8 * (1 + std::abs(there.beta())));
      }
    }
  }
}

TEST_F(GearsInTheChain, GradientsAreThoseOfFiniteDifferences) {
  const Problem task = make_problem(lift_with(telescope(0.5, 260)));
  Options options;
  int compared = 0;
  for (const double q : {-0.1, 0.05, 0.2}) {
    const auto beta = [&](double at) {
      return evaluate(task, Eigen::VectorXd::Constant(1, at), options).beta();
    };
    const Answer answer = evaluate(task, Eigen::VectorXd::Constant(1, q), options);
    if (answer.posture.status != Status::kValid) continue;
    ASSERT_EQ(answer.trajectory.gradient.size(), 1);
    const double h = 1e-6, slope = (beta(q + h) - beta(q - h)) / (2 * h);
    EXPECT_NEAR(answer.trajectory.gradient(0, 0), slope, 1e-4 * (1 + std::abs(slope)));
    ++compared;
  }
  EXPECT_GE(compared, 2);
}

/// A gripper whose second finger mirrors the first; the tool is on the second one. Its leader is
/// beside the chain and moves the tool all the same. Fingers without mass: the motor at the first
/// finger is one of the same force at the second.
TEST_F(GearsInTheChain, TheLeaderMayBeBesideTheChain) {
  const std::string finger = "end_effectors.tool = { link = 'right' }\n";
  const auto gripper = [&](const std::string& left, const std::string& right) {
    return make_problem(lift_with(load(weighty_link("base", 5) + six_joints_on("base") +
                                           "<link name='left'/><link "
                                           "name='right'/>" +
                                           left + right,
                                       finger)));
  };
  const Problem geared = gripper(moved_by_slide("left_slide", "hand", "left", "0 1 0", 0, 0.05, 80),
                                 moved_by_slide("right_slide", "hand", "right", "0 1 0", -0.05, 0,
                                                0, "<mimic joint='left_slide' multiplier='-1'/>"));
  EXPECT_EQ(geared.theta_r_name(0), "left_slide");
  TaskSpec named =
      lift_with(gripper(moved_by_slide("left_slide", "hand", "left", "0 1 0", 0, 0.05, 80),
                        moved_by_slide("right_slide", "hand", "right", "0 -1 0", 0, 0.05, 80))
                    .robot);
  named.joints = std::vector<std::string>{"right_slide"};
  const Problem plain = make_problem(named);
  for (const double q : {0.0, 0.02, 0.05}) {
    const Answer a = evaluate(geared, Eigen::VectorXd::Constant(1, q), {});
    const Answer b = evaluate(plain, Eigen::VectorXd::Constant(1, q), {});
    ASSERT_EQ(a.posture.status, Status::kValid);
    EXPECT_NEAR(a.beta(), b.beta(), 1e-8 * b.beta());
  }
}

TEST_F(GearsInTheChain, WhatDoesNotSupportThemSaysSo) {
  TaskSpec task = lift_with(telescope(0.5, 400));
  const auto why = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  const Problem problem = make_problem(task);
  EXPECT_THAT(why([&] { make_capability_bound(problem, "linf_polytope", Wrench::kPure); }),
              HasSubstr("got a chain that moves 'high_lift' by a gear"));
  Options slp;
  slp.search = "slp";
  EXPECT_NE(why([&] { solve(problem, slp); }), "accepted");
  task.joints = std::vector<std::string>{"j4"};
  EXPECT_THAT(why([&] { make_problem(task); }), HasSubstr("'low_lift' among them"));
}

}  // namespace
}  // namespace maxwrench::urdf
