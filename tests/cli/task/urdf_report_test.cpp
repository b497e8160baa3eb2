#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/support.h"

// What the command says of URDFs that lack something.

namespace maxwrench {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A folder with one URDF, `robot.urdf`.
class UrdfReport : public testing::Test {
 protected:
  void write(const std::string& text) const {
    std::ofstream(folder_.path() / "robot.urdf") << "<robot name='r'>" << text << "</robot>";
  }
  void write_srdf(const std::string& text) const {
    std::ofstream(folder_.path() / "robot.srdf") << "<robot name='r'>" << text << "</robot>";
  }
  CommandResult run(const std::string& words) const { return run_maxwrench(words, folder_.path()); }

  static std::string body(const std::string& name, double mass) {
    return fmt::format(
        "<link name='{}'><inertial><origin xyz='0.5 0 0'/><mass value='{}'/><inertia ixx='0.1' "
        "ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>",
        name, mass);
  }
  /// A joint at 1 m from the one before it.
  static std::string hinge(const std::string& name, const std::string& parent,
                           const std::string& child, double effort,
                           const std::string& axis = "0 1 0", const std::string& more = "") {
    return fmt::format(
        "<joint name='{}' type='revolute'><origin xyz='1 0 0'/><parent link='{}'/><child "
        "link='{}'/><axis xyz='{}'/><limit lower='-2' upper='2' effort='{}' "
        "velocity='1'/>{}</joint>",
        name, parent, child, axis, effort, more);
  }
  TemporaryFolder folder_;
};

/// Positions need no efforts, and the tool may be on the base.
TEST_F(UrdfReport, PoseTakesJointsWithoutEffort) {
  write("<link name='base'/>" + body("rod", 1) + hinge("arm", "base", "rod", 0));
  const CommandResult result = run("pose robot.urdf --tool base --joints arm=0.5 --json");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json object = json::parse(result.out);
  EXPECT_EQ(object["joints"]["arm"], 0.5);
  EXPECT_NEAR(object["links"]["rod"]["rpy"][1], 0.5, 1e-12);
  write("<link name='base'/>");
  EXPECT_THAT(run("pose robot.urdf --tool base --joints arm=0.5").err,
              testing::AnyOf(HasSubstr("expected none: no joint of the robot moves"),
                             HasSubstr("robot.urdf: ")));
}

/// A force at the elbow, where the hand's frame is, bears no part of the hand's moment about it.
TEST_F(UrdfReport, ASearchThatFindsNothingSaysWhy) {
  write("<link name='base'/>" + body("rod", 1) + body("hand", 1) +
        hinge("shoulder", "base", "rod", 50) + hinge("elbow", "rod", "hand", 0));
  const CommandResult result =
      run("solve robot.urdf --tool hand --wrench-along z --joints shoulder=0 --budget 50");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("none_found: nothing that was evaluated has a value: no actuator efforts "
                        "balance the posture; without effort: elbow\n"));
}

/// The weight of a robot without masses is not that of the robot.
TEST_F(UrdfReport, WithoutMassesTheOwnWeightIsNotKnown) {
  write("<link name='base'/><link name='rod'/><link name='hand'/>" +
        hinge("shoulder", "base", "rod", 50) + hinge("elbow", "rod", "hand", 50));
  const std::string text = run("check robot.urdf").out;
  EXPECT_THAT(text, HasSubstr("  whether it holds its own weight is not known: its 2 moving links "
                              "have no mass\n"));
  EXPECT_THAT(text, Not(HasSubstr("random postures")));
}

/// The line about warnings names the command that prints them: with other options it may print
/// others. Here a base that moves has no mass, and the joint beside the tool has no effort.
TEST_F(UrdfReport, TheCommandThatPrintsTheWarningsHasTheSameOptions) {
  write("<link name='base'/>" + body("rod", 1) + body("hand", 1) + body("finger", 1) +
        hinge("shoulder", "base", "rod", 50) + hinge("elbow", "rod", "hand", 50, "1 0 0") +
        hinge("grip", "hand", "finger", 0));
  const std::string options = " --tool hand --base x,y,yaw";
  const CommandResult eval = run("eval robot.urdf --wrench-along x" + options + " --json");
  EXPECT_THAT(eval.err, HasSubstr("2 warnings about the robot: 'maxwrench check robot.urdf" +
                                  options + "' prints them\n"));
  const CommandResult check = run("check robot.urdf" + options);
  EXPECT_EQ(check.exit_status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("warnings 2\n"));
  EXPECT_EQ(check.err, "");  // no pose is asked for
}

/// Two joints about one axis are redundant to each other, but the one that is free to choose leads
/// a gear and must be chosen.
TEST_F(UrdfReport, AGearThatLeavesNoChoiceIsNamed) {
  write("<link name='base'/>" + body("a", 1) + body("b", 1) + body("c", 1) + body("d", 1) +
        hinge("lead", "base", "a", 500, "0 0 1") +
        hinge("follow", "a", "b", 500, "1 0 0", "<mimic joint='lead'/>") +
        hinge("one", "b", "c", 500) +
        "<joint name='two' type='revolute'><parent link='c'/><child link='d'/><axis xyz='0 1 "
        "0'/><limit lower='-2' upper='2' effort='500' velocity='1'/></joint>");
  const CommandResult result = run("eval robot.urdf --tool d --joints one=0.3");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_THAT(result.err, HasSubstr("--tool: got 'd', expected one that one, two can move in all "
                                    "its directions: the joint that leads a gear is in theta_r "
                                    "(here lead)"));
}

TEST_F(UrdfReport, AGearHasNoEffortOfItsOwn) {
  write("<link name='base'/>" + body("a", 1) + body("b", 1) + hinge("lead", "base", "a", 500) +
        hinge("follow", "a", "b", 100, "0 1 0", "<mimic joint='lead' multiplier='0.5'/>"));
  const std::string text = run("check robot.urdf").out;
  EXPECT_THAT(text, testing::ContainsRegex(
                        "joint follow +-2 \\.\\. 2 rad, mimics lead, ratio 0.5, offset 0\n"));
}

TEST_F(UrdfReport, CheckListsTheStatesOfAnSrdfAndItsUnknownLinks) {
  write("<link name='base'/>" + body("rod", 1) + hinge("arm", "base", "rod", 50));
  write_srdf(
      "<group_state name='ready' group='arm'><joint name='arm' value='0.5'/></group_state>"
      "<disable_collisions link1='base' link2='ghost'/>");
  const std::string text = run("check robot.urdf --srdf robot.srdf").out;
  EXPECT_THAT(text, testing::ContainsRegex("  posture ready +arm=0.5\n"));
  EXPECT_THAT(text, HasSubstr("warning: robot.srdf: disable_collisions: not in the URDF, so no "
                              "pair: ghost\n"));
}

/// Two arms on a turning torso, and the groups of one of them.
class SrdfCommand : public UrdfReport {
 protected:
  SrdfCommand() {
    write("<link name='base'/>" + body("torso", 1) + body("left", 1) + body("hand", 1) +
          body("right", 1) + hinge("waist", "base", "torso", 500, "0 0 1") +
          hinge("shoulder", "torso", "left", 200) + hinge("elbow", "left", "hand", 100) +
          hinge("other", "torso", "right", 200));
    write_srdf(
        "<group name='arm'><chain base_link='torso' tip_link='hand'/></group>"
        "<group name='both'><group name='arm'/><joint name='other'/></group>"
        "<group_state name='turned' group='both'><joint name='waist' value='0.5'/>"
        "<joint name='elbow' value='0.25'/></group_state>");
  }
};

TEST_F(SrdfCommand, CheckSaysWhichJointsMoveAndWhereTheOthersAre) {
  EXPECT_THAT(run("check robot.urdf --srdf robot.srdf").out,
              HasSubstr("note: groups of the SRDF, of which none was chosen: arm, both\n"));
  const std::string text = run("check robot.urdf --srdf robot.srdf --group arm --rest turned").out;
  EXPECT_THAT(text, HasSubstr("degrees of freedom 2: base {}, 2 joints\n"));
  EXPECT_THAT(text, HasSubstr("end effectors hand (on hand)\n"));
  EXPECT_THAT(text, HasSubstr("note: group arm: joints shoulder, elbow; locked at waist=0.5; 1 "
                              "locked at rest\n"));
}

/// With both axes horizontal, the hand's frame is at 1 m (torso) + 1 m (left) + cos(0.25) in the
/// direction in which the waist is turned.
TEST_F(SrdfCommand, APostureAlsoPlacesTheJointsOutside) {
  const std::string group = " robot.urdf --srdf robot.srdf --group arm ";
  const auto hand = [&](const std::string& words) {
    const CommandResult result = run("pose" + group + words + " --json");
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return json::parse(result.out)["links"]["hand"]["position"];
  };
  const json turned = hand("--posture turned");
  // base -> waist at 1 m, then the shoulder and the elbow 1 m further each.
  EXPECT_NEAR(turned[0], 1 + 2 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(turned[1], 2 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(hand("--rest turned")[1], 2 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(hand("--rest waist=-0.25 --posture turned")[1], -2 * std::sin(0.25), 1e-12);
  EXPECT_NEAR(hand("")[1], 0, 1e-12);
  // A task needs no --tool: the tip of the group is it.
  const CommandResult eval = run("eval" + group + "--posture turned --json");
  ASSERT_EQ(eval.exit_status, 0) << eval.err;
  const json answer = json::parse(eval.out);
  EXPECT_EQ(answer["theta"]["elbow"], 0.25);
  EXPECT_FALSE(answer["theta"].contains("waist"));
  EXPECT_EQ(run("solve" + group + "--budget 50 --joints elbow=0.5 --json").exit_status, 0);
}

TEST_F(SrdfCommand, InitWritesTheGroup) {
  ASSERT_EQ(run("init robot.urdf --srdf robot.srdf --group arm --out made").exit_status, 0);
  const CommandResult made = run("check made/robot.toml");
  EXPECT_EQ(made.exit_status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("degrees of freedom 2: base {}, 2 joints\n"));
  EXPECT_EQ(run("check made/task.toml").exit_status, 0);
}

TEST_F(SrdfCommand, WrongGroupsEndWithOneLine) {
  const std::string srdf = " robot.urdf --srdf robot.srdf";
  const std::vector<std::pair<std::string, std::string>> uses = {
      {"check" + srdf + " --group leg",
       "--group: got 'leg', expected a group of the SRDF: arm, both"},
      {"eval" + srdf + " --group ''", "--group: got ''"},
      {"check robot.urdf --group arm", "--group: got 'arm', expected an SRDF beside it"},
      {"check" + srdf + " --group arm --rest bent",
       "--rest: got 'bent', expected a named posture of the SRDF: turned"},
      {"eval" + srdf + " --group arm --posture bent",
       "--posture: got 'bent', expected a named posture of the SRDF: turned"},
      {"solve" + srdf + " --group arm --posture bent",
       "--posture: got 'bent', expected a named posture of the SRDF: turned"},
      {"check" + srdf + " --group arm --rest elbow=0.1",
       "--rest: got 'elbow', expected a joint outside of the group arm"},
      {"check" + srdf + " --group arm --rest waist=", "--rest: got 'waist='"},
      {"check" + srdf + " --rest turned", "--rest: got 'turned', expected none without --group"},
      {"eval" + srdf + " --group both", "--tool: got nothing, expected an end effector"},
      {"eval planar/force --group arm", "--group: got 'arm', expected none: planar/force is not"}};
  for (const auto& [words, expected] : uses) {
    const CommandResult result = run(words);
    EXPECT_EQ(result.exit_status, 2) << words << '\n' << result.err;
    EXPECT_THAT(result.err, HasSubstr(expected)) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << words;
  }
}

/// The example stands in front of the base.
TEST_F(UrdfReport, InitChoosesAPoseInFrontOfTheBase) {
  for (const char* robot : {"panda/panda", "ur10/ur10"}) {
    const TemporaryFolder folder;
    const std::string urdf = std::string(MAXWRENCH_SOURCE_DIR) + "/tests/data/robots/" + robot;
    ASSERT_EQ(run_maxwrench("init '" + urdf + ".urdf' --out new", folder.path()).exit_status, 0);
    const std::string task = read_text(folder.path() / "new/task.toml");
    const std::size_t at = task.find("xyz = [");
    ASSERT_NE(at, std::string::npos) << task;
    std::array<double, 3> position = {};
    ASSERT_EQ(std::sscanf(task.c_str() + at, "xyz = [%lf, %lf, %lf]", position.data(),
                          position.data() + 1, position.data() + 2),
              3);
    EXPECT_GT(position[0], std::abs(position[1])) << robot;
    EXPECT_GT(position[2], 0) << robot;
  }
}

}  // namespace
}  // namespace maxwrench
