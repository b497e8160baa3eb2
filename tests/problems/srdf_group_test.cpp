#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "lib/robot/kinematics.h"
#include "problems/make/posture.h"
#include "tests/support/written_urdf.h"

// The groups of an SRDF: whose joints move, where the others are locked, and what the end effectors
// are.

namespace maxwrench {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using urdf::joint, urdf::link, urdf::UrdfTest;

constexpr const char* kAwayFromZero = "<limit lower='0.3' upper='2' effort='5' velocity='1'/>";

/// Two arms on a torso that turns; the left one has a hand with two fingers.
std::string two_arms() {
  return link("base") + link("torso") + link("l1") + link("l2") + link("l_hand") + link("f1") +
         link("f2") + link("r1") + link("r2") + joint("waist", "base", "torso") +
         joint("l_shoulder", "torso", "l1") + joint("l_elbow", "l1", "l2") +
         joint("l_wrist", "l2", "l_hand", "", "fixed") + joint("grip", "l_hand", "f1") +
         joint("follow", "l_hand", "f2", "<mimic joint='grip' multiplier='-1'/>") +
         joint("r_shoulder", "torso", "r1") + joint("r_elbow", "r1", "r2", kAwayFromZero);
}

constexpr const char* kGroups =
    "<robot name='r'><virtual_joint name='world' type='fixed' parent_frame='map' "
    "child_link='base'/>"
    "<group name='left'><chain base_link='torso' tip_link='l_hand'/></group>"
    "<group name='left_and_waist'><chain base_link='base' tip_link='l_hand'/></group>"
    "<group name='right'><joint name='world'/><joint name='r_shoulder'/><joint "
    "name='r_elbow'/></group>"
    "<group name='hand'><link name='f1'/><link name='f2'/></group>"
    "<group name='arms'><group name='left'/><group name='right'/></group>"
    "<group name='circle'><group name='right'/><group name='circle'/></group>"
    "<group name='wrist'><joint name='l_wrist'/></group>"
    "<group name='broken'><group name='ghost'/></group>"
    "<group name='backwards'><chain base_link='l_hand' tip_link='torso'/></group>"
    "<group name='across'><chain base_link='r2' tip_link='l_hand'/></group>"
    "<group name='palm'><link name='l_hand'/><link name='base'/><link name='f1'/><link "
    "name='r2'/><link name='r1'/></group>"
    "<group name='of_ghosts'><joint name='ghost'/></group>"
    "<group_state name='up' group='arms'><joint name='waist' value='0.5'/>"
    "<joint name='l_elbow' value='0.7'/><joint name='r_elbow' value='1'/></group_state></robot>";

class SrdfGroup : public UrdfTest {
 protected:
  SrdfGroup() {
    load(two_arms());
    std::ofstream(folder_.path() / "r.srdf") << kGroups;
  }

  UrdfOptions options(const std::string& group) const {
    return {.srdf = folder_.path() / "r.srdf", .group = group};
  }
  Robot load_group(const UrdfOptions& with) const {
    return load_urdf(folder_.path() / "robot.urdf", with);
  }
  std::string error_of(const UrdfOptions& with) const {
    try {
      load_group(with);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }
  static std::vector<std::string> joints_of(const Robot& robot) {
    std::vector<std::string> names;
    for (const Joint& each : robot.joints) names.push_back(each.name);
    return names;
  }
  static std::vector<std::string> tips_of(const Robot& robot) {
    std::vector<std::string> names;
    for (const EndEffector& each : robot.end_effectors) names.push_back(each.name);
    return names;
  }
};

/// The pose of an end effector with some joints of the robot at these positions, the others at
/// zero.
Pose<double> pose_of(const Robot& robot, const std::string& tip,
                     const std::map<std::string, double>& positions) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const auto at = positions.find(robot.joints[i].name);
    if (at != positions.end()) q[static_cast<Eigen::Index>(i)] = at->second;
  }
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  for (const EndEffector& each : robot.end_effectors) {
    if (each.name == tip) return kinematics.end_effector(each);
  }
  ADD_FAILURE() << tip;
  return {};
}

TEST_F(SrdfGroup, TheJointsOfAChainMoveToItsTip) {
  const Robot left = load_group(options("left"));
  EXPECT_THAT(joints_of(left), ElementsAre("l_shoulder", "l_elbow"));
  EXPECT_THAT(tips_of(left), ElementsAre("l_hand"));
  EXPECT_THAT(left.notes, Contains("group left: joints l_shoulder, l_elbow; 4 locked at rest"));
  // All of its masses are still there: each link has 1 kg.
  double mass = 0;
  for (const Link& each : left.links) mass += each.mass;
  EXPECT_DOUBLE_EQ(mass, 9);
  EXPECT_THAT(joints_of(load_group(options("left_and_waist"))),
              ElementsAre("waist", "l_shoulder", "l_elbow"));
}

/// The hand is where it is on the whole robot with the same joints.
TEST_F(SrdfGroup, JointsOutsideAreLockedWhereTheyAreToBe) {
  const Robot whole = load_urdf(folder_.path() / "robot.urdf", {.tool = "l_hand"});
  const std::map<std::string, double> arm = {{"l_shoulder", 0.4}, {"l_elbow", -0.3}};
  const auto expect_hand = [&](const UrdfOptions& with, double waist) {
    auto all = arm;
    all["waist"] = waist;
    const Pose<double> expected = pose_of(whole, "l_hand", all);
    const Pose<double> got = pose_of(load_group(with), "l_hand", arm);
    EXPECT_LT((expected.p - got.p).norm() + (expected.R - got.R).norm(), 1e-14) << waist;
  };
  UrdfOptions left = options("left");
  expect_hand(left, 0);
  left.posture = "up";
  expect_hand(left, 0.5);
  left.rest = {{"waist", 1.25}};
  expect_hand(left, 1.25);
  left = options("left");
  left.rest_posture = "up";
  expect_hand(left, 0.5);
  // Zero is beyond the limits of this joint, which therefore stays at 0.3.
  const Robot full = load_urdf(folder_.path() / "robot.urdf", {.tool = "r2"});
  UrdfOptions with_tool = options("left_and_waist");
  with_tool.tool = "r2";
  const Pose<double> expected = pose_of(full, "r2", {{"waist", 0.2}, {"r_elbow", 0.3}});
  const Pose<double> got = pose_of(load_group(with_tool), "r2", {{"waist", 0.2}});
  EXPECT_LT((expected.p - got.p).norm(), 1e-14);
}

TEST_F(SrdfGroup, AGroupOfLinksOrOfGroupsHasSeveralTips) {
  const Robot arms = load_group(options("arms"));
  EXPECT_THAT(joints_of(arms), ElementsAre("l_shoulder", "l_elbow", "r_shoulder", "r_elbow"));
  EXPECT_THAT(tips_of(arms), ElementsAre("l_hand", "r2"));
  // The finger that follows moves with its leader.
  const Robot hand = load_group(options("hand"));
  EXPECT_THAT(joints_of(hand), ElementsAre("grip", "follow"));
  EXPECT_THAT(tips_of(hand), ElementsAre("f1", "f2"));
  EXPECT_TRUE(hand.joints[1].gear);
  EXPECT_THAT(joints_of(load_group(options("circle"))), ElementsAre("r_shoulder", "r_elbow"));
  // The hand is fixed to what this group does not move, and carries a finger that it does.
  const Robot palm = load_group(options("palm"));
  EXPECT_THAT(joints_of(palm), ElementsAre("grip", "follow", "r_shoulder", "r_elbow"));
  EXPECT_THAT(tips_of(palm), ElementsAre("f1", "r2"));
}

/// As for MoveIt, a chain may lead up and down again.
TEST_F(SrdfGroup, AChainLeadsThroughTheLinkThatCarriesBothEnds) {
  const Robot across = load_group(options("across"));
  EXPECT_THAT(joints_of(across), ElementsAre("l_shoulder", "l_elbow", "r_shoulder", "r_elbow"));
  EXPECT_THAT(tips_of(across), ElementsAre("l_hand"));
  const Robot backwards = load_group(options("backwards"));
  EXPECT_THAT(joints_of(backwards), ElementsAre("l_shoulder", "l_elbow"));
  EXPECT_THAT(tips_of(backwards), ElementsAre("torso"));
}

TEST_F(SrdfGroup, ATaskIsThatOfItsGroup) {
  TaskSpec task;
  task.posture = {{"l_shoulder", 0.2}, {"l_elbow", 0.4}};
  task.c = Vector6d::Unit(2);
  const auto make = [&](const UrdfOptions& with) {
    return make_urdf_problem(folder_.path() / "robot.urdf", with, task);
  };
  const Problem at_rest = make(options("left"));
  EXPECT_EQ(at_rest.robot.end_effectors[static_cast<std::size_t>(at_rest.end_effector)].name,
            "l_hand");
  UrdfOptions turned = options("left");
  turned.rest = {{"waist", 0.5}};
  UrdfOptions up = options("left");
  up.rest_posture = "up";
  const std::set<std::string> digests = {at_rest.digest, make(turned).digest, make(up).digest,
                                         make(options("left_and_waist")).digest};
  EXPECT_EQ(digests.size(), 4u);
  // The named posture of the group without what does not move.
  EXPECT_EQ(named_posture(at_rest.robot, "posture", "up"),
            (std::map<std::string, double>{{"l_elbow", 0.7}}));
}

TEST_F(SrdfGroup, ATomlNamesItsGroup) {
  const std::string head = "name = 'r'\nbase = { axes = [] }\nsrdf = 'r.srdf'\n";
  const Robot left = load_toml(head + "group = 'left'\ngroup_rest = 'up'\n");
  EXPECT_THAT(joints_of(left), ElementsAre("l_shoulder", "l_elbow"));
  EXPECT_THAT(tips_of(left), ElementsAre("l_hand"));
  EXPECT_THAT(left.notes,
              Contains("group left: joints l_shoulder, l_elbow; locked at waist=0.5, r_elbow=1; 2 "
                       "locked at rest"));
  // What the TOML locks stays there, and its own end effectors count.
  const Robot own = load_toml(head + "group = 'left'\njoints.waist.lock = 0.25\n" +
                              "end_effectors.tool = { link = 'l2' }\n");
  EXPECT_THAT(tips_of(own), ElementsAre("tool"));
  const Robot whole = load_urdf(folder_.path() / "robot.urdf", {.tool = "l2"});
  EXPECT_LT((pose_of(own, "tool", {}).p - pose_of(whole, "l2", {{"waist", 0.25}}).p).norm(), 1e-14);
  const auto rejected = [&](const std::string& more) {
    return rejection(two_arms(), "srdf = 'r.srdf'\n" + more);
  };
  EXPECT_THAT(rejected("group_rest = 'up'\n"), HasSubstr("robot.toml: group_rest: got"));
  EXPECT_THAT(rejected("group = 'tail'\n"), HasSubstr("robot.toml: group: got 'tail', expected a "
                                                      "group of the SRDF: across, "));
  EXPECT_THAT(rejected("group = 'left'\ngroup_rest = 'down'\n"),
              HasSubstr("group_rest: got 'down', expected a named posture of the SRDF: up"));
  EXPECT_THAT(rejection(two_arms(), "group = 'left'\n"),
              HasSubstr("group: got 'left', expected an SRDF"));
}

TEST_F(SrdfGroup, WrongGroupsAreNamedInOneLine) {
  EXPECT_THAT(error_of(options("tail")),
              HasSubstr("group: got 'tail', expected a group of the SRDF"));
  EXPECT_THAT(error_of(options("broken")), HasSubstr("group: got 'ghost', expected a group"));
  EXPECT_THAT(error_of(options("wrist")),
              HasSubstr("got 'wrist', expected a group with a joint that moves"));
  EXPECT_THAT(error_of(options("of_ghosts")), HasSubstr("which has no 'ghost'"));
  EXPECT_THAT(error_of({.group = "left"}), HasSubstr("group: got 'left', expected an SRDF"));
  UrdfOptions bad = options("left");
  bad.rest = {{"l_elbow", 0.1}};
  EXPECT_THAT(error_of(bad),
              HasSubstr("rest: got 'l_elbow', expected a joint outside of the group left"));
  bad.rest = {{"tail", 0.1}};
  EXPECT_THAT(error_of(bad), HasSubstr("rest: got 'tail'"));
  bad = options("left");
  bad.rest = {{"waist", 100}};
  EXPECT_THAT(error_of(bad), HasSubstr("rest: got waist = 100, expected a position within its "
                                       "limits "));
  bad.rest_posture = "down";
  EXPECT_THAT(error_of(bad),
              HasSubstr("rest: got 'down', expected a named posture of the SRDF: up"));
  bad = options("");
  bad.rest_posture = "up";
  EXPECT_THAT(error_of(bad), HasSubstr("rest: got 'up', expected none without a group"));
}

}  // namespace
}  // namespace maxwrench
