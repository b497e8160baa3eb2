#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/edited_copy.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// k rows of valve_trajectory, all at the default but where `edit` says so.
std::string table(const std::vector<std::pair<int, std::string>>& edits, int rows = 10) {
  std::string text = "q1_shoulder_yaw,q2_shoulder_pitch,q3_elbow,q4_wrist_roll\n";
  for (int i = 1; i <= rows; ++i) {
    std::string row = "3.0643,0.6895,0.4288,-3.0278";
    for (const auto& [knot, other] : edits)
      if (knot == i) row = other;
    text += row + "\n";
  }
  return text;
}

TEST(TrajectoryTable, IsEvaluated) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "knots.csv") << table({});
  const CommandResult result =
      run_maxwrench("eval uvms/valve_trajectory --theta-r knots.csv --json", folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NEAR(json::parse(result.out)["value"], 34.30190, 1e-5);
}

struct BadTable {
  const char* name;
  int exit_status;
  std::string text;
  std::vector<std::string> mentions;
};

class BadTrajectoryTable : public testing::TestWithParam<BadTable> {};

INSTANTIATE_TEST_SUITE_P(
    Each, BadTrajectoryTable,
    testing::Values(
        BadTable{"rows", 2, table({}, 9), {"knots.csv: rows: got 9, expected 10"}},
        BadTable{"columns", 2, "1,2,3\n", {"knots.csv: "}},
        BadTable{"nan", 2, table({{3, "3.0643,nan,0.4288,-3.0278"}}), {"knots.csv: ", "nan"}},
        BadTable{
            "words", 2, table({{3, "3.0643,a,0.4288,-3.0278"}}), {"knots.csv: ", "line 4", ",a,"}},
        BadTable{"limit",
                 1,
                 table({{4, "3.0643,9,0.4288,-3.0278"}}),
                 {"joint limit", "knot 4", "q2_shoulder_pitch"}},
        BadTable{"speed",
                 1,
                 table({{4, "3.0643,1.6895,0.4288,-3.0278"}}),
                 {"speed limit", "knots 3 and 4", "q2_shoulder_pitch"}}),
    [](const auto& named) { return named.param.name; });

TEST_P(BadTrajectoryTable, IsRejectedOrInvalid) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "knots.csv") << GetParam().text;
  const std::string words = "eval uvms/valve_trajectory --theta-r knots.csv";
  const CommandResult result = run_maxwrench(words + " --json", folder.path());
  EXPECT_EQ(result.exit_status, GetParam().exit_status) << result.err;
  const bool rejected = GetParam().exit_status == 2;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), rejected ? 1 : 0);
  EXPECT_EQ(result.out.empty(), rejected);
  const std::string& said = rejected ? result.err : result.out;
  for (const std::string& part : GetParam().mentions)
    EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
  if (rejected) return;
  const json trajectory = json::parse(result.out);
  EXPECT_EQ(trajectory["status"], "invalid_posture");
  for (const char* key : {"value", "beta", "value_between_knots", "gradient", "residual"})
    EXPECT_TRUE(trajectory[key].is_null()) << key;
  EXPECT_EQ(run_maxwrench(words, folder.path()).exit_status, 1);
}

struct BadMotionWords {
  const char* words;
  const char* mention;
};

class BadMotionCommand : public testing::TestWithParam<BadMotionWords> {};

INSTANTIATE_TEST_SUITE_P(
    Each, BadMotionCommand,
    testing::Values(
        BadMotionWords{"eval uvms/valve --scheme spline",
                       "--scheme: got 'spline', expected none: uvms/valve is a static task"},
        BadMotionWords{"solve uvms/valve --t-h 1", "--t-h: got '1', expected none"},
        BadMotionWords{"eval uvms/valve_trajectory --scheme backward",
                       "--scheme: got 'backward', expected one of "},
        BadMotionWords{"solve uvms/valve_impulse --scheme ends", "for an impulse"},
        BadMotionWords{"eval uvms/valve_trajectory --scheme euler", "'euler'"},
        BadMotionWords{"eval uvms/valve_impulse --t-h 9",
                       "--t-h: got '9', expected a knot from 1 to k = 4, or best"},
        BadMotionWords{"eval uvms/valve_impulse --t-h 0", "got '0'"},
        BadMotionWords{"eval uvms/valve_impulse --t-h 2.5", "got '2.5'"},
        BadMotionWords{"eval uvms/valve_impulse --t-h worst", "got 'worst'"},
        BadMotionWords{"eval uvms/valve_trajectory --t-h 3", "it has no peak"},
        BadMotionWords{"eval uvms/valve --thruster-lag 0.1",
                       "--thruster-lag: got '0.1', expected none: uvms/valve is a static task"},
        BadMotionWords{"eval uvms/valve_trajectory --thruster-lag -1",
                       "--thruster-lag: got '-1', expected a time constant from 0 to 1000 s"},
        BadMotionWords{"eval uvms/valve_trajectory --thruster-lag nan", "--thruster-lag"},
        BadMotionWords{"eval uvms/valve_trajectory --thruster-lag slow", "slow"},
        BadMotionWords{"solve planar/force --worth tank",
                       "--worth: got tank for planar/force, a static task"},
        BadMotionWords{"solve planar/trajectory --worth boat", "boat"},
        BadMotionWords{"solve planar/trajectory --worth tank --simulations 0", "--simulations"},
        BadMotionWords{"solve planar/trajectory --worth plan --simulations 5",
                       "--simulations: got 5"},
        BadMotionWords{"solve planar/trajectory --worth tank --measure ellipsoid",
                       "measure: got ellipsoid"},
        BadMotionWords{"eval uvms/valve_trajectory --measure ellipsoid",
                       "--measure: got 'ellipsoid', expected linf_polytope"},
        BadMotionWords{"eval uvms/valve_trajectory --measure volume", "volume"},
        BadMotionWords{"eval uvms/valve_trajectory --wrench both", "both"},
        BadMotionWords{"eval uvms/valve_trajectory --solver facets",
                       "expected one of facets_or_ipm ipm"},
        BadMotionWords{"eval uvms/valve_trajectory --theta-r 1,2,3",
                       "--theta-r: got '1,2,3', expected 4 numbers or a file of k = 10 rows"},
        BadMotionWords{"eval uvms/valve_trajectory --theta-r 1,2,3,x", "--theta-r"},
        BadMotionWords{"eval uvms/valve_trajectory --theta-r 1", "--theta-r: got '1'"},
        BadMotionWords{"eval uvms/valve_trajectory --theta-r ''", "--theta-r: got ''"},
        BadMotionWords{"eval uvms/valve_trajectory --theta-r none.csv", "none.csv"},
        BadMotionWords{"eval uvms/valve_trajectory --state s.toml --scheme ends", "--scheme"},
        BadMotionWords{"solve uvms/valve_trajectory --search luck", "luck"},
        BadMotionWords{"solve planar/trajectory --budget 20 --out /proc/nowhere/t.csv",
                       "/proc/nowhere"},
        BadMotionWords{"solve planar/trajectory --out problems/planar/trajectory.toml",
                       "--out: got 'problems/planar/trajectory.toml'"}));

TEST_P(BadMotionCommand, ExitsWithTwoAndOneLine) {
  const CommandResult result = run_maxwrench(GetParam().words);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(GetParam().mention), std::string::npos) << result.err;
}

/// One knot holds the start of the path, at rest: the static value.
TEST(TrajectoryTable, OneKnotIsAStaticPosture) {
  EditedCopy copy;
  copy.replace("trajectory.toml", "k = 8\nscheme = \"spline\"\ninstants_per_interval = 4",
               "k = 1\nscheme = \"ends\"");
  const std::string words = " trajectory.toml --json";
  const CommandResult one = run_maxwrench("eval" + words, copy.path());
  ASSERT_EQ(one.exit_status, 0) << one.err;
  const json trajectory = json::parse(one.out);
  EXPECT_EQ(trajectory["instants"].size(), 1U);
  EXPECT_EQ(trajectory["value_between_knots"], trajectory["value"]);
  const CommandResult spline = run_maxwrench("eval --scheme spline" + words, copy.path());
  EXPECT_EQ(spline.exit_status, 2);
  EXPECT_NE(spline.err.find("--scheme: got 'spline', expected another scheme for k = 1"),
            std::string::npos)
      << spline.err;
}

}  // namespace
}  // namespace maxwrench
