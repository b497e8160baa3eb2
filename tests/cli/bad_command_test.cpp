#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/edited_copy.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

void expect_one_line_of_complaint(const CommandResult& result, const std::string& mention) {
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(mention), std::string::npos) << result.err;
}

struct BadWords {
  const char* words;
  const char* mention;
};

class BadCommandLine : public testing::TestWithParam<BadWords> {};

INSTANTIATE_TEST_SUITE_P(
    Each, BadCommandLine,
    testing::Values(
        BadWords{"", "subcommand"}, BadWords{"evaluate planar/force", "evaluate"},
        BadWords{"eval", "problem"}, BadWords{"eval planar/force --speed 3", "--speed"},
        BadWords{"eval planar/nothing", "planar/nothing"},
        BadWords{"eval planar/force --measure volume", "volume"},
        BadWords{"eval planar/force --wrench both", "both"},
        BadWords{"eval planar/force --solver cplex", "cplex"},
        BadWords{"eval planar/force --solver facets --wrench any", "facets"},
        BadWords{"eval planar/force --measure ellipsoid --solver simplex", "simplex"},
        BadWords{"eval planar/force --measure saturating_wrench --wrench any", "any"},
        BadWords{"eval planar/force --measure manipulability --solver facets", "facets"},
        BadWords{"eval planar/force --measure dynamic_capability --wrench any", "any"},
        BadWords{"solve planar/two_arms --measure dynamic_manipulability", "second contact"},
        BadWords{"eval dual_arm/bar_wall --solver facets", "second contact"},
        BadWords{"solve dual_arm/two_arms --solver facets", "second contact"},
        BadWords{"compare planar/two_arms --solver facets", "second contact"},
        BadWords{"eval planar/force --theta-r 0.3", "--theta-r"},
        BadWords{"eval planar/force --theta-r 0.3,0.1,0.2", "--theta-r"},
        BadWords{"eval planar/force --theta-r 0.3,nan", "--theta-r"},
        BadWords{"eval planar/force --theta-r 0.3,x", "--theta-r"},
        BadWords{"eval planar/force --theta-r 0.3,", "--theta-r"},
        BadWords{"eval planar/force --state none.toml", "none.toml: file"},
        BadWords{"eval planar/force --state s.toml --solver simplex", "--solver"},
        BadWords{"solve planar/force --search luck", "luck"},
        BadWords{"solve planar/force --search sample+luck", "got 'luck'"},
        BadWords{"solve planar/force --search cmaes+grid", "grid accepts no start"},
        BadWords{"solve planar/two_arms --search joint_nlp", "second contact"},
        BadWords{"solve planar/force --measure ellipsoid --search slp",
                 "--search: got 'slp', which supports only linf_polytope"},
        BadWords{"run planar/force measure=ellipsoid search=slp", "search: got 'slp'"},
        BadWords{"solve " MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/luus.toml --search dp",
                 "--search: got 'dp', which does not support a transfer"},
        BadWords{"solve planar/force --budget 0", "budget"},
        BadWords{"solve planar/force --budget many", "--budget"},
        BadWords{"solve planar/force --budget 99999999999", "100000000"},
        BadWords{"run budget=99999999999", "1 to 100000000"},
        BadWords{"run seed=-1", "seed: got '-1'"}, BadWords{"run seed=", "10^19"},
        BadWords{"eval planar/force --theta-r ''", "--theta-r"},
        BadWords{"simulate uvms/valve --integrator euler", "systems: cvode ida"},
        BadWords{"solve planar/force --seed -1", "--seed"},
        BadWords{"solve planar/force --seed 99999999999999999999", "10^19"},
        BadWords{"solve planar/force --threads -2", "--threads"},
        BadWords{"run colour=red", "colour"}, BadWords{"run measure", "measure"},
        BadWords{"run measure=volume", "measure: got 'volume'"}, BadWords{"run budget=few", "few"},
        BadWords{"run budget=1 --out /proc/nowhere", "/proc/nowhere"},
        BadWords{"compare planar/none", "planar/none"},
        BadWords{"compare planar/force --seeds 0", "--seeds"},
        BadWords{"compare planar/force --budget 0", "budget"},
        BadWords{"compare planar/force --solver cplex", "cplex"},
        BadWords{"simulate uvms/none", "uvms/none"},
        BadWords{"simulate uvms/valve --planned -3", "--planned: got -3, expected"},
        BadWords{"simulate uvms/valve --planned nan", "--planned: got nan"},
        BadWords{"simulate uvms/lift --load 0", "--load: got 0, expected a mass > 0"},
        BadWords{"simulate uvms/valve --load 3", "upward force"},
        BadWords{"simulate uvms/valve --heaviest", "upward force"},
        BadWords{"simulate uvms/lift --load 3 --planned 9", "excludes"},
        BadWords{"simulate uvms/valve --ramp 0", "--ramp: got 0, expected between"},
        BadWords{"simulate uvms/valve --hold inf", "--hold: got inf"},
        BadWords{"simulate uvms/valve --integrator euler", "euler"},
        BadWords{"simulate uvms/valve --integrator arkode", "stiff"},
        BadWords{"simulate uvms/valve --thrust-noise -1", "--thrust-noise: got -1"},
        BadWords{"simulate uvms/valve --thrust-efficiency x", "--thrust-efficiency"},
        BadWords{"simulate uvms/valve --seed 1.5", "--seed: got '1.5', expected"},
        BadWords{"simulate uvms/valve --theta-r 1", "--theta-r: got 1 numbers"},
        BadWords{"simulate dual_arm/bar_wall", "second contact"},
        BadWords{"simulate uvms/valve --t-h 3", "--t-h: got '3', expected none"},
        BadWords{"simulate uvms/valve --interpolation linear", "a static task"},
        BadWords{"simulate uvms/valve_trajectory --interpolation cubic",
                 "--interpolation: got cubic, expected linear or spline"},
        BadWords{"simulate uvms/valve_trajectory --ramp 3",
                 "--ramp: got a trajectory, expected a static task"},
        BadWords{"simulate uvms/lift_impulse --load 3", "--load: got an impulse"},
        BadWords{"simulate uvms/valve_trajectory --t-h 1", "--t-h: got '1'"},
        BadWords{"simulate uvms/valve_impulse --scheme ends", "--scheme: got 'ends'"},
        BadWords{"simulate uvms/valve_impulse --theta-r 1,2", "expected 4 numbers"},
        BadWords{"simulate uvms/valve_impulse --solver facets", "--solver: got 'facets'"},
        BadWords{"simulate uvms/valve_impulse --measure ellipsoid",
                 "--measure: got ellipsoid, expected linf_polytope"},
        BadWords{"simulate uvms/valve_impulse --theta-r none.csv", "none.csv"},
        BadWords{"simulate uvms/lift --load 1 --wrench any", "--wrench"},
        BadWords{"simulate uvms/valve --measure manipulability", "--measure"},
        BadWords{"simulate planar/force --ramp 0.1 --hold 0.1 --out /proc/x", "/proc/x"},
        BadWords{"plot planar/trajectory --theta-r 1,2,3", "got '1,2,3'"},
        BadWords{"plot planar/force --scheme ends", "is a static task"},
        BadWords{"run planar/trajectory scheme=backward", "scheme: got 'backward'"},
        BadWords{"run planar/trajectory measure=ellipsoid", "got 'ellipsoid'"},
        BadWords{"compare planar/trajectory --solver facets", "solver: got 'facets'"},
        BadWords{"compare planar/force --scheme ends", "is a static task"},
        BadWords{"check missing.toml", "missing.toml"},
        BadWords{"plot planar/none", "planar/none"}));

TEST_P(BadCommandLine, ExitsWithTwoAndOneLine) {
  expect_one_line_of_complaint(run_maxwrench(GetParam().words), GetParam().mention);
}

struct BadEdit {
  const char* name;
  const char* file;
  const char* from;
  const char* to;
  std::vector<const char*> mentions;
};

class BadFile : public testing::TestWithParam<BadEdit> {};

INSTANTIATE_TEST_SUITE_P(
    Each, BadFile,
    testing::Values(
        BadEdit{"syntax", "force.toml", "[pose]", "[pose", {"force.toml"}},
        BadEdit{"unknown_key", "force.toml", "label =", "lable =", {"force.toml", "lable"}},
        BadEdit{"missing_robot", "force.toml", "\"vehicle.toml\"", "\"boat.toml\"", {"boat.toml"}},
        BadEdit{"missing_urdf", "vehicle.toml", "\"vehicle.urdf\"", "\"boat.urdf\"", {"boat.urdf"}},
        BadEdit{"no_number", "force.toml", "c = [1, 0", "c = [nan, 0", {"force.toml", "wrench.c"}},
        BadEdit{"no_direction", "force.toml", "c = [1, 0", "c = [0, 0", {"force.toml", "wrench.c"}},
        BadEdit{"short_direction", "force.toml", "c = [1, 0, ", "c = [1, ", {"wrench.c", "6"}},
        BadEdit{"reference", "force.toml", "[wrench]", "[wrench]\nreference = 0", {"reference"}},
        BadEdit{"desired",
                "force.toml",
                "[wrench]",
                "[wrench]\ndesired = [1, 1, 1, 1, 1, -1]",
                {"wrench.desired"}},
        BadEdit{"outside_any", "force.toml", "\"fx\", ", "", {"force.toml", "wrench"}},
        BadEdit{
            "base_axes", "vehicle.toml", "\"x\", \"y\", \"yaw\"", "\"x\", \"yaw\"", {"base.axes"}},
        BadEdit{
            "thrust_limits", "vehicle.toml", "force_min = -1.0", "force_min = 2.0", {"force_min"}},
        BadEdit{"thrust_direction", "vehicle.toml", "[4, -1, 0]", "[0, 0, 0]", {"direction"}},
        BadEdit{"joint_limits", "vehicle.urdf", "lower=\"-1.04", "lower=\"nan ", {"vehicle.urdf"}},
        BadEdit{"unknown_link", "vehicle.toml", "link = \"link_2\"", "link = \"hand\"", {"hand"}},
        BadEdit{"default_size", "force.toml", "default = [0, 0]", "default = [0]", {"default"}},
        BadEdit{
            "default_outside", "force.toml", "default = [0, 0]", "default = [0, 3]", {"default"}},
        BadEdit{"end_effector", "force.toml", "\"tool\"", "\"claw\"", {"claw"}}),
    [](const auto& edit) { return edit.param.name; });

TEST_P(BadFile, ExitsWithTwoAndOneLine) {
  EditedCopy copy;
  copy.replace(GetParam().file, GetParam().from, GetParam().to);
  for (const char* command : {"check ", "eval "}) {
    const CommandResult result =
        run_maxwrench(command + ("'" + (copy.path() / "force.toml").string() + "'"));
    for (const char* mention : GetParam().mentions) expect_one_line_of_complaint(result, mention);
  }
}

/// A broken file among the shipped ones hides none of the others.
TEST(BadShippedFile, SLOW_IsNamedBesideTheHealthyOnes) {
  const TemporaryFolder folder;
  const auto list = [&](const std::string& problems) {
    return run_maxwrench(
        "--version > /dev/null; MAXWRENCH_PROBLEMS='" + problems + "' '" MAXWRENCH_COMMAND "' list",
        folder.path());
  };
  const std::filesystem::path copy = folder.path() / "problems";
  std::filesystem::copy(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems", copy,
                        std::filesystem::copy_options::recursive);
  const CommandResult healthy = list(copy.string());
  EXPECT_EQ(healthy.exit_status, 0) << healthy.err;
  std::ofstream(copy / "fixed/push.toml", std::ios::app) << "[wrench\n";
  const CommandResult broken = list(copy.string());
  EXPECT_EQ(broken.exit_status, 2);
  EXPECT_EQ(std::count(broken.err.begin(), broken.err.end(), '\n'), 1) << broken.err;
  EXPECT_NE(broken.err.find("fixed/push.toml"), std::string::npos) << broken.err;
  // All lines but one are as they were.
  const std::size_t begin = healthy.out.find("  fixed/push ");
  ASSERT_NE(begin, std::string::npos);
  std::string others = healthy.out;
  others.erase(begin, others.find('\n', begin) + 1 - begin);
  EXPECT_EQ(broken.out, others);
}

TEST(BadState, MotionThatOverflowsIsRejected) {
  const TemporaryFolder folder;
  std::string text =
      read_text(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems/uvms/state_example.toml");
  const std::string speed = "velocity = [0.2";
  ASSERT_NE(text.find(speed), std::string::npos);
  std::ofstream(folder.path() / "fast.toml")
      << text.replace(text.find(speed), speed.size(), "velocity = [1e200");
  expect_one_line_of_complaint(
      run_maxwrench("eval uvms/valve --state fast.toml --json", folder.path()), "fast.toml");
}

}  // namespace
}  // namespace maxwrench
