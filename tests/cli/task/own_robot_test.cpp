#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// Files as a stranger writes them: an arm of six joints, efforts 90 to 15 N m times `strength`, on
/// a driven rail along x.
class StrangersFolder {
 public:
  explicit StrangersFolder(double strength = 1) {
    std::string urdf =
        "<robot name='gantry'>\n<link name='carriage'><inertial><mass value='20'/>"
        "<inertia ixx='0.3' ixy='0' ixz='0' iyy='0.3' iyz='0' izz='0.3'/></inertial></link>\n";
    const char* places[] = {"0 0 0.2", "0 0 0.1", "0.5 0 0", "0.3 0 0", "0.15 0 0", "0.1 0 0"};
    const char* axes[] = {"0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"};
    for (int i = 0; i < 6; ++i) {
      const std::string parent = i == 0 ? "carriage" : fmt::format("part{}", i - 1);
      urdf += fmt::format(
          "<link name='part{0}'><inertial><origin xyz='0.05 0 0'/><mass value='2'/>"
          "<inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link>\n"
          "<joint name='a{0}' type='revolute'><parent link='{1}'/><child link='part{0}'/>"
          "<origin xyz='{2}'/><axis xyz='{3}'/>"
          "<limit lower='-2.8' upper='2.8' effort='{4}' velocity='1'/></joint>\n",
          i, parent, places[i], axes[i], strength * (90 - 15 * i));
    }
    write("gantry.urdf", urdf + "</robot>\n");
    write("gantry.toml", fmt::format(R"(
      name = "gantry"
      urdf = "gantry.urdf"
      [base]
      axes = ["x"]
      xyz = [0, -0.5, 0.3]
      [environment]
      gravity = {}
      [thrusters]
      force_min = {}
      force_max = {}
      [[thrusters.list]]
      name = "belt"
      position = [0, 0, 0]
      direction = [1, 0, 0]
      [end_effectors.tip]
      link = "part5"
      xyz = [0.1, 0, 0])",
                                     gravity_, -200 * strength, 200 * strength));
    write("task.toml", R"(
      type = "static"
      robot = "gantry.toml"
      end_effector = "tip"
      label = "test"
      source = "test"
      [pose]
      xyz = [1, 0, 0.6]
      rpy = [0, 0.3, 0.4]
      [wrench]
      c = [0, 1, 0, 0, 0, 0]
      [theta_r]
      joints = ["a0"]
      default = [0.6]
      guess = { a1 = -0.5, a2 = 1, a4 = -0.3 }
      guess_base = { x = 0.3 })");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  json ask(const std::string& words) const {
    const CommandResult result = run_maxwrench(words + " --json", folder_.path());
    EXPECT_EQ(result.exit_status, 0) << result.err << result.out;
    return json::parse(result.out);
  }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  static constexpr double gravity_ = 0;  // so that beta is proportional to the efforts
  TemporaryFolder folder_;
};

TEST(OwnRobot, IsCheckedEvaluatedAndSolvedFromItsFilesAlone) {
  const StrangersFolder folder;
  const CommandResult check = run_maxwrench("check task.toml", folder.path());
  EXPECT_EQ(check.exit_status, 0) << check.err;
  for (const char* part : {"redundancy 1", "theta_r a0", "dependent a1", "dependent a5", "base {x}",
                           "default posture: exists", "rank of B 7 of 7"}) {
    EXPECT_NE(check.out.find(part), std::string::npos) << part << "\n" << check.out;
  }
  EXPECT_EQ(run_maxwrench("check gantry.toml", folder.path()).exit_status, 0);

  const json posture = folder.ask("eval task.toml");
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(posture["theta"].contains(fmt::format("a{}", i)));
  EXPECT_EQ(posture["theta"]["a0"], 0.6);
  EXPECT_EQ(posture["theta"]["position"][1], -0.5);  // the rail's
  EXPECT_EQ(posture["theta"]["position"][2], 0.3);
  EXPECT_LT(posture["residual"]["balance"], 1e-9);
  EXPECT_EQ(posture["u"].size(), 7U);

  const json best = folder.ask("solve task.toml --search grid --budget 600 --threads 2");
  EXPECT_GT(best["beta"], posture["beta"]);
  EXPECT_EQ(folder.ask("solve task.toml --search grid --budget 600 --threads 1")["beta"],
            best["beta"]);
  const json any = folder.ask("eval task.toml --wrench any");
  EXPECT_GE(any["beta"], posture["beta"]);
  EXPECT_EQ(run_maxwrench("plot task.toml --out gantry.svg", folder.path()).exit_status, 0);
}

TEST(OwnRobot, TwiceTheEffortsAreTwiceTheCapability) {
  const json once = StrangersFolder(1).ask("eval task.toml");
  const json twice = StrangersFolder(2).ask("eval task.toml");
  EXPECT_NEAR(twice["beta"], 2 * once["beta"].get<double>(), 1e-9);
}

TEST(OwnRobot, ShippedProblemsHaveADefaultThatExists) {
  for (const char* name : {"planar/force", "uvms/valve", "mobile/push", "fixed/push"}) {
    const CommandResult result = run_maxwrench(std::string("eval ") + name);
    EXPECT_EQ(result.exit_status, 0) << name << result.out << result.err;
  }
}

/// Six joints and a fixed base leave nothing free: eval and solve answer for the one posture.
TEST(OwnRobot, NothingRedundantIsOnePosture) {
  const StrangersFolder folder;
  std::string robot = read_text(folder.path() / "gantry.toml");
  robot.replace(robot.find("axes = [\"x\"]"), 12, "axes = []");
  folder.write("gantry.toml", robot);
  std::string task = read_text(folder.path() / "task.toml");
  task = task.substr(0, task.find("[theta_r]")) +
         "[theta_r]\nguess = { a0 = 0.6, a1 = -0.5, a2 = 1, a4 = -0.3 }\n";
  folder.write("task.toml", task);
  const json posture = folder.ask("eval task.toml");
  EXPECT_TRUE(posture["theta_r"].empty());
  const json best = folder.ask("solve task.toml --search grid --budget 10");
  EXPECT_EQ(best["beta"], posture["beta"]);
  // The arm is 1.35 m long.
  task.replace(task.find("xyz = [1, 0, 0.6]"), 17, "xyz = [2, 0, 0.6]");
  folder.write("task.toml", task);
  const CommandResult far = run_maxwrench("check task.toml", folder.path());
  EXPECT_EQ(far.exit_status, 2);
  EXPECT_NE(far.err.find("task.toml: pose.xyz: got [2, 0, 0.6], expected"), std::string::npos)
      << far.err;
}

}  // namespace
}  // namespace maxwrench
