#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/robot/chain.h"
#include "tests/support/written_urdf.h"

namespace maxwrench {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using urdf::joint, urdf::kLimit, urdf::link, urdf::UrdfTest;

/// What a joint beside the way to the tool lacks, and where it is then locked.
struct Lacking {
  const char *name, *finger, *type, *warning;
};
class LackingJoint : public UrdfTest, public testing::WithParamInterface<Lacking> {};

TEST_P(LackingJoint, IsLockedAndTheWarningSaysWhy) {
  const Robot robot = load_finger(GetParam().finger, "", GetParam().type);
  ASSERT_EQ(robot.joints.size(), 1u);
  EXPECT_EQ(robot.joints[0].name, "arm");
  // The hand is part of the upper link, 1 m from its joint.
  EXPECT_EQ(robot.links[1].mass, 2);
  EXPECT_THAT(robot.warnings, Contains(HasSubstr(GetParam().warning)));
}

INSTANTIATE_TEST_SUITE_P(
    Urdf, LackingJoint,
    testing::Values(
        Lacking{"effort", "<limit lower='-1' upper='1' velocity='1'/>", "revolute",
                "joint[finger].limit.effort: missing: the joint is locked at 0"},
        Lacking{"effort_0", "<limit lower='-1' upper='1' effort='0' velocity='1'/>", "revolute",
                "joint[finger].limit.effort: 0: the joint is locked at 0"},
        Lacking{"effort_negative", "<limit effort='-1' velocity='1'/>", "continuous",
                "joint[finger].limit.effort: -1: the joint is locked at 0"},
        Lacking{"limit", "", "prismatic", "joint[finger].limit: without lower and upper"},
        Lacking{"floating", "", "floating", "joint[finger].type: floating: locked"},
        Lacking{"planar", "", "planar", "joint[finger].type: planar: locked"},
        Lacking{"lock_of_limits", "<limit lower='0.5' upper='1' velocity='1'/>", "revolute",
                "joint[finger].limit.effort: missing: the joint is locked at 0.5"},
        Lacking{"mimic_of_nothing", "<mimic joint='toe'/><limit effort='1' velocity='1'/>",
                "revolute", "'toe' is no joint of the file: the joint is locked at 0"},
        Lacking{"mimic_of_itself", "<mimic joint='finger'/><limit effort='1' velocity='1'/>",
                "revolute", "mimic each other in a circle: the joint is locked at 0"},
        Lacking{"mimic_by_0",
                "<mimic joint='arm' multiplier='0' offset='0.2'/>"
                "<limit lower='0' upper='1' effort='1' velocity='1'/>",
                "revolute", "multiplier 0: the joint is locked at 0.2"}),
    [](const auto& test) { return std::string(test.param.name); });

/// A joint that is on the way moves.
struct Repaired {
  const char *name, *limit, *type;
  double q_min, q_max, effort, velocity;
  const char* warning;
};
class RepairedJoint : public UrdfTest, public testing::WithParamInterface<Repaired> {};

TEST_P(RepairedJoint, MovesAndTheWarningSaysHow) {
  const Repaired& given = GetParam();
  const Robot robot =
      load(link("base") + link("tip") + joint("hinge", "base", "tip", given.limit, given.type),
           "end_effectors.tool = { link = 'tip' }\n");
  ASSERT_EQ(robot.joints.size(), 1u);
  EXPECT_DOUBLE_EQ(robot.joints[0].q_min, given.q_min);
  EXPECT_DOUBLE_EQ(robot.joints[0].q_max, given.q_max);
  EXPECT_DOUBLE_EQ(robot.joints[0].effort_max, given.effort);
  EXPECT_DOUBLE_EQ(robot.joints[0].velocity_max, given.velocity);
  EXPECT_THAT(robot.warnings, ElementsAre(HasSubstr(given.warning)));
}

constexpr double kPi = std::numbers::pi;
INSTANTIATE_TEST_SUITE_P(
    Urdf, RepairedJoint,
    testing::Values(
        Repaired{"without_effort", "<limit lower='0' upper='1' velocity='2'/>", "revolute", 0, 1, 0,
                 2, "joint[hinge].limit.effort: missing, which counts as a joint that nothing"},
        Repaired{"velocity_0", "<limit lower='0' upper='1' effort='3' velocity='0'/>", "revolute",
                 0, 1, 3, kInfinity, "joint[hinge].limit.velocity: 0, which counts as no limit"},
        Repaired{"velocity_missing", "<limit lower='0' upper='1' effort='3'/>", "revolute", 0, 1, 3,
                 kInfinity, "joint[hinge].limit.velocity: missing: no limit"},
        Repaired{"swapped", "<limit lower='1' upper='-1' effort='3' velocity='2'/>", "revolute", -1,
                 1, 3, 2, "lower 1 is above upper -1: they are swapped"},
        Repaired{"many_turns", "<limit lower='-1e16' upper='1e16' effort='3' velocity='2'/>",
                 "revolute", -kPi, kPi, 3, 2, "counts as -pi .. pi"},
        Repaired{"no_range", "<limit effort='3' velocity='2'/>", "revolute", 0, 0, 3, 2,
                 "without lower and upper, which counts as 0 .. 0"},
        Repaired{"millimetres", "<limit lower='0' upper='300' effort='3' velocity='2'/>",
                 "prismatic", 0, 300, 3, 2, "millimetres?"},
        Repaired{"ten_each_way", "<limit lower='-10' upper='10' effort='3' velocity='2'/>",
                 "revolute", -10, 10, 3, 2, "limit: -10 .. 10 rad looks like a placeholder"},
        Repaired{"two_turns_and_more", "<limit lower='0' upper='13' effort='3' velocity='2'/>",
                 "revolute", 0, 13, 3, 2, "limit: 0 .. 13 rad looks like a placeholder"},
        Repaired{"placeholder", "<limit lower='0' upper='1' effort='1000' velocity='2'/>",
                 "revolute", 0, 1, 1000, 2, "1000 looks like a placeholder"},
        Repaired{"nines", "<limit lower='0' upper='1' effort='9999' velocity='2'/>", "revolute", 0,
                 1, 9999, 2, "9999 looks like a placeholder"}),
    [](const auto& test) { return std::string(test.param.name); });

/// Wrists that turn twice each way exist, ten metres of a rail too, and what the TOML says is
/// meant.
TEST_F(UrdfTest, WideRangesThatAreMeantAreNoPlaceholders) {
  const auto warnings_of = [&](const std::string& range, const std::string& type,
                               const std::string& toml = "") {
    const std::string limit = "<limit " + range + " effort='5' velocity='1'/>";
    return load_finger(limit, toml, type).warnings;
  };
  EXPECT_THAT(warnings_of("lower='-12.566' upper='12.566'", "revolute"), IsEmpty());
  EXPECT_THAT(warnings_of("lower='-9.9' upper='10'", "revolute"), IsEmpty());
  EXPECT_THAT(warnings_of("lower='-10' upper='10'", "prismatic"), IsEmpty());
  EXPECT_THAT(warnings_of("lower='-10' upper='10'", "continuous"), IsEmpty());
  EXPECT_THAT(warnings_of("lower='-10' upper='10'", "revolute", "joints.finger.upper = 20\n"),
              IsEmpty());
}

TEST_F(UrdfTest, TomlCountsMoreThanTheFile) {
  const Robot robot = load(link("base") + link("tip") + joint("hinge", "base", "tip", "<limit/>"),
                           R"(
    end_effectors.tool = { link = 'tip' }
    joints.hinge = { effort = 7, velocity = 8, lower = -2, upper = 3 }
    links.tip = { mass = 9, com = [0.1, 0, 0], inertia = [1, 2, 3, 0.1, 0.2, 0.3] }
  )");
  EXPECT_THAT(robot.warnings, IsEmpty());
  EXPECT_EQ(robot.joints[0].effort_max, 7);
  EXPECT_EQ(robot.joints[0].velocity_max, 8);
  EXPECT_EQ(robot.joints[0].q_min, -2);
  EXPECT_EQ(robot.joints[0].q_max, 3);
  EXPECT_EQ(robot.links[1].mass, 9);
  EXPECT_EQ(robot.links[1].com.x(), 0.1);
  EXPECT_EQ(robot.links[1].inertia(1, 1), 2);
  EXPECT_EQ(robot.links[1].inertia(1, 2), 0.3);
}

TEST_F(UrdfTest, LockedJointHoldsItsPosition) {
  const Robot robot = load_finger(kLimit, "joints.finger.lock = 1.5707963267948966\n");
  ASSERT_EQ(robot.joints.size(), 1u);
  // A quarter turn about y, 1 m along x: z points along the upper link's x.
  const Robot with_tip =
      load(link("base") + link("upper") + link("hand") + joint("arm", "base", "upper") +
               joint("finger", "upper", "hand"),
           "end_effectors.tool = { link = 'hand' }\njoints.finger.lock = 1.5707963267948966\n");
  const EndEffector& tool = with_tip.end_effectors[0];
  EXPECT_EQ(tool.link, 1);
  EXPECT_TRUE(tool.placement.p.isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(tool.placement.R.col(2).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
}

/// No posture that turns it reaches a pose: as a joint it would count as one that does.
TEST_F(UrdfTest, JointWithoutRangeIsLocked) {
  const std::string limit = "<limit lower='0.5' upper='0.5' effort='5' velocity='1'/>";
  const std::string arm = link("base") + link("upper") + link("hand") +
                          joint("arm", "base", "upper") + joint("finger", "upper", "hand", limit);
  const Robot robot = load(arm, "end_effectors.tool = { link = 'hand' }\n");
  ASSERT_EQ(robot.joints.size(), 1u);
  EXPECT_THAT(robot.warnings, ElementsAre("joint[finger].limit: 0.5 .. 0.5: the joint is locked "
                                          "there"));
  // Half a radian about y: z points along (sin 0.5, 0, cos 0.5).
  EXPECT_NEAR(robot.end_effectors[0].placement.R(0, 2), std::sin(0.5), 1e-12);
  EXPECT_EQ(
      load(arm, "end_effectors.tool = { link = 'hand' }\njoints.finger.upper = 1\n").joints.size(),
      2u);
  // What the file leaves out may be anything.
  EXPECT_EQ(load_finger("<limit effort='5' velocity='1'/>").joints.size(), 2u);
}

/// A URDF is repaired, but its TOML is the user's own.
TEST_F(UrdfTest, SlipsInTheTomlAreRejected) {
  const std::string arm = link("base") + link("upper") + link("hand") +
                          joint("arm", "base", "upper") + joint("finger", "upper", "hand");
  const auto error_of = [&](const std::string& toml) {
    return rejection(arm, "end_effectors.tool = { link = 'upper' }\n" + toml);
  };
  EXPECT_THAT(error_of("joints.finger.mimic = { joint = 'toe' }\n"),
              HasSubstr("robot.toml: joints.finger.mimic.joint: got 'toe', expected the name of "
                        "another joint of the URDF"));
  EXPECT_THAT(error_of("joints.finger.mimic = { joint = 'finger' }\n"),
              HasSubstr("joints.finger.mimic.joint: got 'finger', expected the name of another"));
  EXPECT_THAT(error_of("joints.finger.mimic = { joint = 'arm', ratio = 0 }\n"),
              HasSubstr("joints.finger.mimic.ratio: got 0, expected another number"));
  EXPECT_THAT(error_of("joints.arm.lower = 3\n"),
              HasSubstr("robot.toml: joints.arm.lower: got 3, expected at most the upper limit 2"));
  EXPECT_THAT(error_of("joints.arm.upper = -2\n"),
              HasSubstr("joints.arm.upper: got -2, expected at least the lower limit -1"));
  EXPECT_EQ(error_of("joints.finger.mimic = { joint = 'arm', ratio = -1 }\n"), "accepted");
  EXPECT_THAT(error_of("joints.finger = { lock = 0.25, mimic = { joint = 'arm' } }\n"),
              HasSubstr("robot.toml: joints.finger.lock: got 0.25, expected no such key beside "
                        "mimic"));
  EXPECT_EQ(error_of("joints.finger.lock = 0.25\n"), "accepted");
}

TEST_F(UrdfTest, GearPassesItsLoadToTheLeader) {
  // Two fingers beside the tool turn about y at the base: the leader l carries 2 kg at 1 m, the
  // follower f carries 3 kg at 1 m and turns by -0.5 of the leader plus 0.25.
  const std::string body =
      "<inertial><origin xyz='1 0 0'/><mass value='%'/><inertia ixx='1' "
      "ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
  const auto heavy = [&body](const std::string& name, const std::string& mass) {
    std::string text = body;
    return "<link name='" + name + "'>" + text.replace(text.find('%'), 1, mass);
  };
  const Robot robot = load(
      link("base") + link("arm") + heavy("l", "2") + heavy("f", "3") + joint("a", "base", "arm") +
          joint("lead", "base", "l", "<limit lower='-1' upper='1' effort='50' velocity='1'/>") +
          joint("follow", "base", "f",
                "<mimic joint='lead' multiplier='-0.5' offset='0.25'/>"
                "<limit lower='0' upper='2' effort='1000' velocity='1'/>"),
      "end_effectors.tool = { link = 'arm' }\n");
  ASSERT_EQ(robot.joints.size(), 3u);
  ASSERT_TRUE(robot.joints[2].gear.has_value());
  EXPECT_EQ(robot.joints[2].gear->leader, 1);
  // The follower's limits are -3.5 .. 0.5 of the leader.
  EXPECT_EQ(robot.joints[1].q_min, -1);
  EXPECT_EQ(robot.joints[1].q_max, 0.5);
  EXPECT_THAT(resting_joints(robot), ElementsAre(0, 0, 0.25));
  // With loads tau of the joints, u = B^-1 tau: the motor of the leader bears its own load and
  // -0.5 of the follower's. A weight m g at 1 m turned by q loads the axis y by -m g cos q.
  Kinematics<double> kinematics(robot);
  Eigen::VectorXd tau;
  kinematics.set_joints(resting_joints(robot));
  kinematics.gravity_and_buoyancy(Eigen::Matrix3d::Identity(), tau);
  const Eigen::VectorXd u = robot.actuation.B.fullPivLu().solve(tau);
  EXPECT_NEAR(u[1], -2 * 9.81 + 0.5 * 3 * 9.81 * std::cos(0.25), 1e-12);
  EXPECT_GT(robot.actuation.u_max[2], 1000 * 9.81);
}

TEST_F(UrdfTest, GearsWithContradictingLimitsAreNamed) {
  const Robot robot = load_finger(kLimit, "");
  EXPECT_THAT(robot.warnings, IsEmpty());
  const Robot odd =
      load(link("base") + link("a") + link("b") + link("c") + joint("arm", "base", "a") +
               joint("lead", "base", "b",
                     "<limit lower='1' upper='2' effort='5' "
                     "velocity='1'/>") +
               joint("follow", "base", "c",
                     "<mimic joint='lead' multiplier='-1'/>"
                     "<limit lower='1' upper='2'/>"),
           "end_effectors.tool = { link = 'a' }\n");
  EXPECT_THAT(odd.warnings, Contains(HasSubstr("does the multiplier -1 have the wrong sign?")));
}

/// One motion, and the gear's leader would have to follow.
TEST_F(UrdfTest, AGearThatThePoseWouldHaveToMoveIsRejectedByTheTask) {
  TaskSpec task;
  task.robot = load(link("base") + link("a") + link("b") + joint("arm", "base", "a") +
                        joint("rod", "a", "b", "<mimic joint='arm'/>"),
                    "end_effectors.tool = { link = 'b' }\n");
  task.end_effector = "tool";
  task.c << 0, 0, 1, 0, 0, 0;
  try {
    make_problem(task);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(
        error.what(),
        HasSubstr("end_effector: got a chain with gears (joints with mimic) that arm leads"));
  }
}

TEST_F(UrdfTest, MimicOfAMimicFollowsTheFirst) {
  const std::string limit = "<limit lower='-1' upper='1' effort='5' velocity='1'/>";
  const Robot robot =
      load(link("base") + link("t") + link("a") + link("b") + link("c") +
               joint("arm", "base", "t") + joint("one", "base", "a", limit) +
               joint("two", "base", "b", "<mimic joint='one' multiplier='2' offset='0.1'/>") +
               joint("three", "base", "c", "<mimic joint='two' multiplier='-3' offset='0.2'/>"),
           "end_effectors.tool = { link = 't' }\n");
  // three = -3 (2 one + 0.1) + 0.2 = -6 one - 0.1
  ASSERT_TRUE(robot.joints[3].gear.has_value());
  EXPECT_EQ(robot.joints[3].gear->leader, 1);
  EXPECT_DOUBLE_EQ(robot.joints[3].gear->ratio, -6);
  EXPECT_NEAR(robot.joints[3].gear->offset, -0.1, 1e-15);
}

}  // namespace
}  // namespace maxwrench
