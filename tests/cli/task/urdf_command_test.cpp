#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kUr10 = fs::path(MAXWRENCH_SOURCE_DIR) / "tests/data/robots/ur10/ur10.urdf";
const fs::path kPanda = fs::path(MAXWRENCH_SOURCE_DIR) / "tests/data/robots/panda/panda.urdf";
const std::string kAt = " --at '0.7 0.2 0.5 / 3.0 0.1 0'";

/// A folder with ur10.urdf and files of its own.
class UrdfFolder {
 public:
  UrdfFolder() { fs::copy(kUr10, folder_.path()); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  CommandResult run(const std::string& words) const { return run_maxwrench(words, folder_.path()); }
  json ask(const std::string& words) const {
    const CommandResult result = run(words + " --json");
    EXPECT_EQ(result.exit_status, 0) << words << '\n' << result.err << result.out;
    return result.exit_status == 0 ? json::parse(result.out) : json();
  }
  /// A task in TOML that does what the options of a URDF do.
  void write_task(const std::string& base, const std::string& c) const {
    write("arm.toml",
          "name = 'arm'\nurdf = 'ur10.urdf'\n" + base + "[end_effectors.tool0]\nlink = 'tool0'\n");
    write("task.toml",
          "type = 'static'\nrobot = 'arm.toml'\nend_effector = 'tool0'\nlabel = 'test'\nsource = "
          "'test'\n"
          "[pose]\nxyz = [0.7, 0.2, 0.5]\nrpy = [3.0, 0.1, 0]\n[wrench]\n" +
              c);
  }
  const fs::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

TEST(UrdfCommand, AnswersAsTheTaskInToml) {
  const UrdfFolder folder;
  const std::vector<std::pair<std::string, std::string>> wrenches = {
      {"", "c = [0, 0, 1, 0, 0, 0]"},
      {" --wrench-along -z", "c = [0, 0, -1, 0, 0, 0]"},
      {" --wrench-along rx", "c = [0, 0, 0, 1, 0, 0]"},
      {" --wrench-along 1,0,-0.5,0,0,0", "c = [1, 0, -0.5, 0, 0, 0]"},
      {" --wrench-along x --wrench-frame tool", "c = [1, 0, 0, 0, 0, 0]\nframe = 'end_effector'"}};
  for (const auto& [words, c] : wrenches) {
    folder.write_task("", c);
    const json by_task = folder.ask("eval task.toml");
    const json by_urdf = folder.ask("eval ur10.urdf --tool tool0" + kAt + words);
    EXPECT_EQ(by_urdf["beta"], by_task["beta"]) << words;
    EXPECT_EQ(by_urdf["unit"], by_task["unit"]) << words;
    EXPECT_EQ(by_urdf["theta"], by_task["theta"]) << words;
    EXPECT_EQ(by_urdf["task_digest"].get<std::string>().size(), 16U);
  }
}

TEST(UrdfCommand, SolvesWithAParkedBase) {
  const UrdfFolder folder;
  folder.write_task("[base]\naxes = ['x', 'y', 'yaw']\nparked = true\n", "c = [0, 0, 1, 0, 0, 0]");
  const std::string words = " --search crs2 --budget 200";
  const json by_task = folder.ask("solve task.toml" + words);
  const json by_urdf = folder.ask("solve ur10.urdf --base yaw,x,y --tool tool0" + kAt + words);
  EXPECT_EQ(by_urdf["theta_r"].size(), 3U);
  EXPECT_EQ(by_urdf["theta_r"], by_task["theta_r"]);
  EXPECT_EQ(by_urdf["beta"], by_task["beta"]);
}

/// A six-joint arm on a fixed base has no theta_r.
TEST(UrdfCommand, AnEmptyThetaRSuitsEveryCommand) {
  const UrdfFolder folder;
  const std::string arm = " ur10.urdf --tool tool0" + kAt;
  const json at_pose = folder.ask("eval" + arm);
  EXPECT_TRUE(at_pose["theta_r"].is_array() && at_pose["theta_r"].empty());
  EXPECT_TRUE(at_pose["gradient"].is_array() && at_pose["gradient"].empty());
  EXPECT_EQ(folder.ask("solve" + arm)["beta"], at_pose["beta"]);
  const json proof = folder.ask("certify" + arm);
  EXPECT_EQ(proof["status"], "proven");
  EXPECT_EQ(proof["beta"], at_pose["beta"]);
  EXPECT_EQ(folder.run("plot" + arm).out.find("<svg"), 0U);
  const std::string text = folder.run("solve" + arm).out;
  EXPECT_EQ(text.find("theta_r  "), std::string::npos) << text;
  EXPECT_EQ(text.find("gradient"), std::string::npos) << text;
  const CommandResult check = folder.run("check" + arm);
  EXPECT_EQ(check.exit_status, 0) << check.err;
  EXPECT_NE(check.out.find("redundancy 0\n"), std::string::npos) << check.out;
}

/// The posture at rest of this arm is singular.
TEST(UrdfCommand, WithoutAPoseItFindsOneAndSaysWhere) {
  const UrdfFolder folder;
  const CommandResult result = folder.run("eval ur10.urdf --tool tool0 --json");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const std::size_t at = result.err.find("--at '");
  ASSERT_NE(at, std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  const std::string words = result.err.substr(at, result.err.find('\n') - at);
  const json again = folder.ask("eval ur10.urdf --tool tool0 " + words);
  const double beta = json::parse(result.out)["beta"];
  EXPECT_NEAR(again["beta"], beta, 1e-3 * beta);  // six digits of the pose
}

const char* const kStates =
    "<robot name='ur10'><disable_collisions link1='base_link' link2='tool0'/><group_state "
    "name='ready' group='arm'><joint name='elbow_joint' value='1'/>"
    "<joint name='wrist_2_joint' value='-0.8'/></group_state></robot>";

TEST(UrdfCommand, JointsGiveThePoseOrThePosture) {
  const UrdfFolder folder;
  folder.write("arm.srdf", kStates);
  folder.write("joints.toml", "elbow_joint = 1\nwrist_2_joint = -0.8\n");
  const std::string arm = " ur10.urdf --tool tool0";
  const std::vector<std::string> ways = {" --joints elbow_joint=1,wrist_2_joint=-0.8",
                                         " --joints joints.toml",
                                         " --srdf arm.srdf --posture ready"};
  // The posture itself is one of the eight at its pose, the best of which solve finds.
  for (const std::string& way : ways) {
    const json posture = folder.ask("eval" + arm + way);
    EXPECT_EQ(posture["theta"]["elbow_joint"], 1);
    EXPECT_EQ(posture["theta"]["wrist_2_joint"], -0.8);
    EXPECT_EQ(posture["theta"]["wrist_3_joint"], 0);
    const json best = folder.ask("solve" + arm + way);
    EXPECT_EQ(best["ik_solutions"]["most"], 8) << way;
    EXPECT_GE(best["beta"].get<double>(), posture["beta"].get<double>() - 1e-9) << way;
  }
}

TEST(UrdfCommand, ATaskIsEvaluatedInThePostureGiven) {
  const CommandResult by_theta_r =
      run_maxwrench("eval tests/data/robots/panda/push.toml --theta-r 0.7 --json");
  const json at = json::parse(by_theta_r.out);
  std::string list;
  for (const auto& [name, value] : at["theta"].items()) {
    if (!value.is_number()) continue;
    list += fmt::format("{}{}={}", list.empty() ? "" : ",", name, value.get<double>());
  }
  const CommandResult result =
      run_maxwrench("eval tests/data/robots/panda/push.toml --json --joints " + list);
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json given = json::parse(result.out);
  EXPECT_NEAR(given["beta"], at["beta"].get<double>(), 1e-8);
  EXPECT_EQ(given["theta_r"], at["theta_r"]);
  EXPECT_TRUE(given["gradient"].is_null());
  // Where the task holds it.
  EXPECT_NEAR(given["pose"]["position"][0], 0.5, 1e-9);
  EXPECT_NEAR(given["pose"]["position"][2], 0.4, 1e-9);
}

/// A URDF of one link that turns about y, 2 kg at 0.5 m: its weight needs at most 9.81 N m.
std::string pendulum(double effort) {
  return fmt::format(
      "<robot name='pendulum'><link name='base'/><link name='rod'><inertial><origin xyz='0.5 0 0'/>"
      "<mass value='2'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>"
      "</link><joint name='hinge' type='revolute'><parent link='base'/><child link='rod'/>"
      "<axis xyz='0 1 0'/><limit lower='-3.14159265' upper='3.14159265' effort='{}' velocity='1'/>"
      "</joint></robot>",
      effort);
}

/// |cos q| exceeds a half in two thirds of all postures.
TEST(UrdfCommand, CheckSaysWhetherTheRobotHoldsItsOwnWeight) {
  const UrdfFolder folder;
  folder.write("weak.urdf", pendulum(9.81 / 2));
  folder.write("strong.urdf", pendulum(9.82));
  const std::string weak = folder.run("check weak.urdf").out;
  const std::string before = "cannot hold its own weight in ";
  const std::size_t at = weak.find(before);
  ASSERT_NE(at, std::string::npos) << weak;
  EXPECT_NEAR(std::stod(weak.substr(at + before.size())), 66.7, 5);
  EXPECT_NE(weak.find("weakest joint hinge (effort 4.905, needs up to 9.81 N m)"),
            std::string::npos)
      << weak;
  EXPECT_NE(folder.run("check strong.urdf").out.find("holds its own weight in all of 1000"),
            std::string::npos);
}

/// A gear's leader carries the follower: twice the weight at ratio 1.
TEST(UrdfCommand, CheckCountsTheLoadOfGears) {
  const UrdfFolder folder;
  std::string text = pendulum(15);
  text.replace(text.find("</robot>"), 8,
               "<link name='twin'><inertial><origin xyz='0.5 0 0'/><mass value='2'/><inertia "
               "ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link><joint "
               "name='follower' type='revolute'><parent link='base'/><child link='twin'/>"
               "<axis xyz='0 1 0'/><mimic joint='hinge' multiplier='1' offset='0'/><limit "
               "lower='-3.2' upper='3.2' effort='100' velocity='1'/></joint></robot>");
  folder.write("pair.urdf", text);
  const CommandResult result = folder.run("check pair.urdf");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find(", mimics hinge, ratio 1, offset 0\n"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("weakest joint hinge (effort 15, needs up to 19.6 N m)"),
            std::string::npos)
      << result.out;
}

TEST(UrdfCommand, WarningsAreCountedOnceAndAreStrict) {
  const UrdfFolder folder;
  folder.write("odd.urdf", pendulum(0));  // a placeholder
  const CommandResult check = folder.run("check odd.urdf");
  EXPECT_EQ(check.exit_status, 0) << check.err;
  EXPECT_NE(check.out.find("\nwarnings 1\n  warning: "), std::string::npos) << check.out;
  EXPECT_EQ(check.err, "");
  EXPECT_EQ(folder.run("check odd.urdf --strict").exit_status, 1);
  const CommandResult eval = folder.run("eval odd.urdf --wrench-along ry --joints hinge=1 --json");
  EXPECT_EQ(eval.err,
            "maxwrench: 1 warning about the robot: 'maxwrench check odd.urdf' prints it\n");
  EXPECT_EQ(eval.out.find("warning"), std::string::npos);
  EXPECT_EQ(run_maxwrench("check planar/force --strict").exit_status, 0);
  // A link that moves without mass is a warning as well.
  folder.write(
      "light.urdf",
      "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>"
      "<parent link='a'/><child link='b'/><limit effort='1' velocity='1'/></joint></robot>");
  const CommandResult light = folder.run("check light.urdf --strict");
  EXPECT_EQ(light.exit_status, 1);
  EXPECT_NE(light.out.find("  warning: link[b].inertial.mass: got 0, expected a mass > 0"),
            std::string::npos)
      << light.out;
}

TEST(UrdfCommand, PosePrintsWhereEverythingIs) {
  const UrdfFolder folder;
  folder.write("rod.urdf", pendulum(10));
  folder.write("rod.toml",
               "name = 'rod'\nurdf = 'rod.urdf'\n[base]\naxes = []\nxyz = [1, 2, 3]\n"
               "[end_effectors.tip]\nlink = 'rod'\nxyz = [1, 0, 0]\n[states.up]\nhinge = -0.5\n");
  for (const char* words : {" --joints hinge=-0.5", " --posture up"}) {
    const json object = folder.ask(std::string("pose rod.toml --jacobian") + words);
    const json& tip = object["end_effectors"]["tip"];
    // Turned by -0.5 rad about y, the rod points up.
    EXPECT_NEAR(tip["position"][0], 1 + std::cos(0.5), 1e-12);
    EXPECT_EQ(tip["position"][1], 2);
    EXPECT_NEAR(tip["position"][2], 3 + std::sin(0.5), 1e-12);
    EXPECT_NEAR(tip["rpy"][1], -0.5, 1e-12);
    ASSERT_EQ(tip["J"].size(), 6U);
    EXPECT_NEAR(tip["J"][0][0], std::sin(0.5), 1e-12);
    EXPECT_NEAR(tip["J"][2][0], -std::cos(0.5), 1e-12);
    EXPECT_EQ(tip["J"][4][0], 1);
    EXPECT_EQ(object["links"]["base"]["position"], json({1, 2, 3}));
    EXPECT_EQ(object["joints"]["hinge"], -0.5);
  }
  const std::string text = folder.run("pose rod.urdf --tool rod").out;
  EXPECT_NE(text.find("end effector  rod "), std::string::npos) << text;
  EXPECT_EQ(folder.run("pose rod.toml --tool tip").exit_status, 0);
  EXPECT_EQ(run_maxwrench("pose dual_arm/bar_wall --tool right_tool").exit_status, 0);
}

const char* const kLimits = R"(
[limits.peak]
hinge = 60
source = "data sheet"
[limits.continuous]
hinge = 30
)";

TEST(UrdfCommand, NamedLimitsReplaceThoseOfTheUrdf) {
  const UrdfFolder folder;
  folder.write("rod.urdf", pendulum(40));
  folder.write("rod.toml", std::string("name = 'rod'\nurdf = 'rod.urdf'\n[end_effectors.tip]\n"
                                       "link = 'rod'\nxyz = [1, 0, 0]\n") +
                               kLimits);
  folder.write(
      "lift.toml",
      "type = 'static'\nrobot = 'rod.toml'\nend_effector = 'tip'\nlabel = 'test'\nsource = 'test'"
      "\n[pose]\njoints = { hinge = 0 }\n[wrench]\nc = [0, 0, 1, 0, 0, 0]\n");
  // At the end of a level rod of 1 m, less the weight.
  for (const auto& [words, limit] : {std::pair("", 40.0), std::pair(" --limits peak", 60.0),
                                     std::pair(" --limits continuous", 30.0)}) {
    const json object = folder.ask(std::string("eval lift.toml") + words);
    EXPECT_NEAR(object["beta"], limit - 9.81, 1e-9) << words;
    EXPECT_EQ(object.contains("limits"), *words != '\0');
    EXPECT_NEAR(folder.ask(std::string("solve lift.toml --budget 5") + words)["beta"], limit - 9.81,
                1e-9);
  }
  const std::string text = folder.run("eval lift.toml --limits peak").out;
  EXPECT_NE(text.find("  limits peak\n"), std::string::npos) << text;
  EXPECT_NE(folder.run("check rod.toml").out.find("note: limits: peak, continuous\n"),
            std::string::npos);
  const CommandResult other = folder.run("eval lift.toml --limits burst");
  EXPECT_EQ(other.exit_status, 2);
  EXPECT_EQ(other.err,
            "maxwrench: rod.toml: limits: got 'burst', expected one of peak, "
            "continuous\n");
}

struct BadUse {
  const char* words;
  const char* expected;
};

/// One line names the option, what it got and what was expected.
TEST(UrdfCommand, BadUsesEndWithOneLine) {
  const UrdfFolder folder;
  folder.write("arm.srdf", kStates);
  folder.write("bad.toml", "elbow_joint = 'one'\n");
  const std::vector<BadUse> uses = {
      {"eval ur10.urdf", "--tool: got nothing, expected an end effector of the robot: ee_link"},
      {"eval ur10.urdf --tool hand", "--tool: got 'hand'"},
      {"eval ur10.urdf --tool ''", "--tool: got ''"},
      {"eval ur10.urdf --tool tool0 --wrench-along up", "--wrench-along: got 'up'"},
      {"eval ur10.urdf --tool tool0 --wrench-along 0,0,0,0,0,0", "--wrench-along: got [0, 0"},
      {"eval ur10.urdf --tool tool0 --wrench-frame base", "--wrench-frame: got 'base'"},
      {"eval ur10.urdf --tool tool0 --at '1 2 3'", "--at: got '1 2 3'"},
      {"eval ur10.urdf --tool tool0 --at '1 2 3 / 0 0 nan'", "--at: got '1 2 3 / 0 0 nan'"},
      {"eval ur10.urdf --tool tool0 --at '9 0 0 / 0 0 0'", "--at: got [9, 0, 0]"},
      {"eval ur10.urdf --tool tool0 --base x,roll", "--base: got ['x', 'roll']"},
      {"eval ur10.urdf --tool tool0 --base x,up", "--base: got 'x,up'"},
      {"eval ur10.urdf --tool tool0 --joints elbow=1", "--joints: got 'elbow'"},
      {"eval ur10.urdf --tool tool0 --joints elbow_joint", "--joints: got 'elbow_joint'"},
      {"solve ur10.urdf --tool tool0 --joints elbow=1", "--joints: got 'elbow'"},
      {"solve ur10.urdf --tool tool0 --joints elbow_joint=0", "singular"},
      {"eval ur10.urdf --tool tool0 --joints bad.toml", "bad.toml: elbow_joint: got"},
      {"eval ur10.urdf --tool tool0 --posture ready", "--posture: got 'ready', expected none"},
      {"eval ur10.urdf --tool tool0 --srdf arm.srdf --posture home",
       "--posture: got 'home', expected a named posture of the robot: ready"},
      {"solve ur10.urdf --tool tool0 --srdf arm.srdf --posture home", "--posture: got 'home'"},
      {"eval ur10.urdf --srdf none.srdf", "--srdf: got 'none.srdf'"},
      {"eval ur10.urdf --tool tool0 --limits peak", "--limits: got 'peak'"},
      {"certify ur10.urdf --certificate proof.json", "--certificate: got a URDF"},
      {"eval planar/force --tool hand", "--tool: got 'hand', expected none: planar/force is not"},
      {"eval planar/force --at '0 0 0 / 0 0 0'", "--at: got"},
      {"eval planar/force --limits peak", "limits: got 'peak', expected none"},
      {"solve planar/force --joints shoulder=1", "--joints: got 'shoulder=1', expected none"},
      {"solve ur10.urdf --tool tool0 --out ur10.urdf", "--out: got 'ur10.urdf'"},
      {"eval planar/trajectory --joints shoulder=1", "joints: got a task in time"},
      {"init planar/force", "urdf: got 'planar/force', expected a URDF"},
      {"pose ur10.urdf --tool hand", "--tool: got 'hand'"},
      {"pose planar/force --tool hand", "--tool: got 'hand'"},
      {"check none.urdf", "none.urdf: file: got an unreadable file, expected a URDF file"}};
  for (const BadUse& use : uses) {
    const CommandResult result = folder.run(use.words);
    EXPECT_EQ(result.exit_status, 2) << use.words << '\n' << result.err;
    EXPECT_NE(result.err.find(use.expected), std::string::npos) << use.words << '\n' << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace maxwrench
