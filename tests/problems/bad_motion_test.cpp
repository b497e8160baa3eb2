#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "tests/support/bad_input.h"
#include "tests/support/edited_copy.h"

// Tasks in time that are rejected.

namespace maxwrench {
namespace {

struct BadMotion {
  const char* problem;
  ChangedProblem input;
};

void PrintTo(const BadMotion& bad, std::ostream* out) { *out << bad.input.name; }

constexpr const char* kTurn = "uvms/valve_trajectory";
constexpr const char* kTurnFile = "valve_trajectory.toml";
constexpr const char* kImpulse = "uvms/valve_impulse";
constexpr const char* kImpulseFile = "valve_impulse.toml";

/// A static task that is made to move.
constexpr const char* kMoves =
    "type = \"trajectory\"\nmotion = { T = 1, k = 2 }\n"
    "path = { kind = \"line\", displacement = [1, 0, 0] }";

const std::vector<BadMotion> kBadMotions = {
    {kTurn, {"no_motion", kTurnFile, "[motion]\nT = 5", "[motion]", {"motion.T: got nothing"}}},
    {kTurn, {"T_zero", kTurnFile, "T = 5", "T = 0", {"motion.T: got 0", "> 0"}}},
    {kTurn, {"T_negative", kTurnFile, "T = 5", "T = -5", {"motion.T: got -5", "> 0"}}},
    {kTurn, {"T_tiny", kTurnFile, "T = 5", "T = 1e-9", {"motion.T: got 1e-09", "0.001"}}},
    {kTurn, {"T_infinite", kTurnFile, "T = 5", "T = inf", {"motion.T: got inf", "finite"}}},
    {kTurn, {"no_k", kTurnFile, "k = 10", "", {"motion.k: got nothing"}}},
    {kTurn, {"k_zero", kTurnFile, "k = 10", "k = 0", {"motion.k: got 0", "1 to 1000"}}},
    {kTurn, {"k_one", kTurnFile, "k = 10", "k = 1", {"motion.k: got 1", "2 or more", "spline"}}},
    {kTurn, {"k_large", kTurnFile, "k = 10", "k = 1001", {"motion.k: got 1001", "1 to 1000"}}},
    {kTurn, {"k_broken", kTurnFile, "k = 10", "k = 2.5", {"motion.k: got 2.5", "whole"}}},
    {kTurn, {"k_text", kTurnFile, "k = 10", "k = \"ten\"", {"motion.k: got 'ten'"}}},
    {kTurn,
     {"unknown_scheme",
      kTurnFile,
      "\"spline\"",
      "\"central\"",
      {"motion.scheme: got 'central'", "one of forward, ends, spline"}}},
    {kTurn,
     {"scheme_of_a_impulse",
      kTurnFile,
      "\"spline\"",
      "\"backward\"",
      {"motion.scheme: got 'backward'", "one of forward, ends, spline"}}},
    {kTurn,
     {"instants_zero",
      kTurnFile,
      "interval = 4",
      "interval = 0",
      {"motion.instants_per_interval: got 0", "1 to 100"}}},
    {kTurn,
     {"instants_of_another_scheme",
      kTurnFile,
      "\"spline\"",
      "\"ends\"",
      {"motion.instants_per_interval: got 4", "scheme is spline"}}},
    {kTurn,
     {"rates_a_number", kTurnFile, "k = 10", "k = 10\nrates = 1", {"motion.rates: got 1", "true"}}},
    {kTurn,
     {"peak_of_a_turn", kTurnFile, "k = 10", "k = 10\nt_h = 3", {"motion.t_h", "unknown key"}}},
    {kTurn,
     {"unknown_kind", kTurnFile, "\"rotation\"", "\"turn\"", {"path.kind: got 'turn'", "arc"}}},
    {kTurn, {"no_kind", kTurnFile, "kind = \"rotation\"", "", {"path.kind: got nothing"}}},
    {kTurn,
     {"angle_zero",
      kTurnFile,
      "angle = 3.141592653589793",
      "angle = 0",
      {"path.angle: got 0", "other than 0"}}},
    {kTurn,
     {"angle_nan",
      kTurnFile,
      "angle = 3.141592653589793",
      "angle = nan",
      {"path.angle: got nan", "finite"}}},
    {kTurn,
     {"axis_zero", kTurnFile, "[0, 0, 1]", "[0, 0, 0]", {"path.axis: got [0, 0, 0]", "nonzero"}}},
    {kTurn,
     {"unknown_timing",
      kTurnFile,
      "\"cubic\"",
      "\"fast\"",
      {"path.timing: got 'fast'", "quintic"}}},
    {kTurn,
     {"centre_of_a_rotation",
      kTurnFile,
      "axis =",
      "centre = [0, 0, 0]\naxis =",
      {"path.centre", "unknown key"}}},
    {kTurn,
     {"arc_without_centre", kTurnFile, "\"rotation\"", "\"arc\"", {"path.centre: got nothing"}}},
    {kTurn,
     {"frame",
      kTurnFile,
      "[wrench]",
      "[wrench]\nframe = \"base\"",
      {"wrench.frame: got 'base'", "'world' or 'end_effector'"}}},
    {kTurn,
     {"free_pose_in_time",
      kTurnFile,
      "rpy =",
      "free = [\"yaw\"]\nrpy =",
      {"pose.free: got ['yaw']", "static tasks"}}},
    {kTurn,
     {"start_of_a_turn", kTurnFile, "[motion]", "[start]\n[motion]", {"start", "unknown key"}}},
    {kTurn,
     {"line_of_no_length",
      kTurnFile,
      "kind = \"rotation\"\naxis = [0, 0, 1]\nangle = 3.141592653589793",
      "kind = \"line\"\ndisplacement = [0, 0, 0]",
      {"path.displacement: got [0, 0, 0]", "nonzero length"}}},
    {kImpulse,
     {"t_h_beyond_k", kImpulseFile, "t_h = 3", "t_h = 5", {"motion.t_h: got 5", "k = 4"}}},
    {kImpulse, {"t_h_zero", kImpulseFile, "t_h = 3", "t_h = 0", {"motion.t_h: got 0", "'best'"}}},
    {kImpulse, {"t_h_broken", kImpulseFile, "t_h = 3", "t_h = 1.5", {"motion.t_h: got 1.5"}}},
    {kImpulse, {"t_h_text", kImpulseFile, "t_h = 3", "t_h = \"last\"", {"motion.t_h: got 'last'"}}},
    {kImpulse, {"impulse_k_one", kImpulseFile, "k = 4", "k = 1", {"motion.k: got 1", "2 or more"}}},
    {kImpulse,
     {"scheme_of_a_turn",
      kImpulseFile,
      "\"spline\"",
      "\"ends\"",
      {"motion.scheme: got 'ends'", "forward, backward, backward_stop, spline"}}},
    {kImpulse,
     {"unknown_start", kImpulseFile, "\"static\"", "\"calm\"", {"start.kind: got 'calm'", "free"}}},
    {kImpulse, {"no_start", kImpulseFile, "theta_r = [3", "# [3", {"start.theta_r: got nothing"}}},
    {kImpulse,
     {"short_start",
      kImpulseFile,
      "[3.064281330005719, ",
      "[",
      {"start.theta_r: got [0.689", "4 finite numbers"}}},
    {kImpulse,
     {"start_beyond_limits",
      kImpulseFile,
      "[3.064281330005719, ",
      "[30, ",
      {"start.theta_r: got [30, ", "q1_shoulder_yaw within"}}},
    {kImpulse,
     {"default_of_a_impulse",
      kImpulseFile,
      "joints =",
      "default = [3, 0.7, 0.4, -3]\njoints =",
      {"theta_r.default: got [3, ", "start.theta_r"}}},
    {kImpulse,
     {"path_of_a_impulse", kImpulseFile, "[motion]", "[path]\n[motion]", {"path", "unknown key"}}},
    {kImpulse,
     {"frame_of_a_impulse",
      kImpulseFile,
      "[wrench]",
      "[wrench]\nframe = \"world\"",
      {"wrench.frame", "unknown key"}}},
    {"planar/force",
     {"path_of_a_static_task", "force.toml", "[pose]", "[path]\n[pose]", {"path", "unknown key"}}},
    {"planar/force",
     {"motion_of_a_static_task",
      "force.toml",
      "[pose]",
      "[motion]\n[pose]",
      {"motion", "unknown"}}},
    {"planar/two_arms",
     {"second_contact",
      "two_arms.toml",
      "type = \"static\"",
      kMoves,
      {"contact: got a table", "only static tasks"}}},
};

class BadMotionTest : public testing::TestWithParam<BadMotion> {};

TEST_P(BadMotionTest, IsRejectedInOneLine) {
  expect_rejected(GetParam().input, GetParam().problem);
}

INSTANTIATE_TEST_SUITE_P(Loader, BadMotionTest, testing::ValuesIn(kBadMotions),
                         [](const auto& test) { return std::string(test.param.input.name); });

struct BadMotionTable {
  const char* name;
  const char* text;
  std::vector<std::string> message;
};

void PrintTo(const BadMotionTable& bad, std::ostream* out) { *out << bad.name; }

/// Files of poses.
const std::vector<BadMotionTable> kBadTables = {
    {"empty", "", {"poses.csv: rows: got 0", "two"}},
    {"header_only", "t,x,y,z,roll,pitch,yaw\n", {"rows: got 0"}},
    {"one_row", "0,0,0,0,0,0,0\n", {"rows: got 1", "two"}},
    {"other_header", "t,x,y,z,r,p,y\n", {"line 1: got 't,x,y,z,r,p,y'", "t,x,y,z,roll,pitch,yaw"}},
    {"six_columns", "0,0,0,0,0,0\n", {"line 1: got '0,0,0,0,0,0'", "7 (t,x", "or 8 (t,x"}},
    {"a_short_row", "0,0,0,0,0,0,0\n\n1,0,0,0,0,0\n", {"line 3: got '1,0,0,0,0,0'", "7 (t,x"}},
    {"both_kinds", "0,0,0,0,0,0,0\n1,0,0,0,1,0,0,0\n", {"line 2: got", "7 (t,x"}},
    {"nan", "0,0,0,0,0,0,nan\n1,0,0,0,0,0,0\n", {"line 1: got '0,0,0,0,0,0,nan'", "finite"}},
    {"infinite", "0,0,0,0,0,0,0\n1,0,0,0,0,0,-inf\n", {"line 2: got", "finite"}},
    {"a_word", "0,0,0,0,0,0,0\n1,0,0,0,0,0,far\n", {"line 2: got '1,0,0,0,0,0,far'", "finite"}},
    {"an_empty_cell", "0,0,0,0,0,0,0\n1,,0,0,0,0,0\n", {"line 2: got '1,,0,0,0,0,0'"}},
    {"late_start", "1,0,0,0,0,0,0\n2,0,0,0,0,0,0\n", {"line 1: got '1,0,", "t = 0"}},
    {"time_stands", "0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n1,0,0,0,0,0,0\n", {"line 3: got", "rises"}},
    {"time_goes_back", "0,0,0,0,0,0,0\n-1,0,0,0,0,0,0\n", {"line 2: got '-1,", "rises"}},
    {"half_a_turn", "0,0,0,0,1,0,0,0\n1,0,0,0,0,0,0,1\n", {"line 2: got", "at most 3 rad"}},
    {"nearly_half_a_turn", "0,0,0,0,0,0,0\n1,0,0,0,0,0,3.01\n", {"line 2: got", "at most 3 rad"}},
    {"long_quaternion", "0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,1\n", {"line 2: got", "length 1"}},
    {"zero_quaternion", "0,0,0,0,0,0,0,0\n1,0,0,0,1,0,0,0\n", {"line 1: got", "length 1"}},
};

std::string message_of(const std::filesystem::path& task) {
  try {
    load_problem(task.string());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// planar/trajectory along poses.csv.
void follow_poses(EditedCopy& copy) {
  copy.replace("trajectory.toml",
               "kind = \"rotation\"\naxis = [0, 0, 1]\nangle = 1.5707963267948966\n"
               "timing = \"cubic\"",
               "kind = \"poses\"\nfile = \"poses.csv\"");
}

class BadPosesTest : public testing::TestWithParam<BadMotionTable> {};

TEST_P(BadPosesTest, AreRejectedInOneLineThatNamesTheTable) {
  EditedCopy copy;
  follow_poses(copy);
  const std::string task = read_text(copy.path() / "trajectory.toml");
  std::string without = task;
  without.replace(without.find("[pose]"), without.find("[path]") - without.find("[pose]"), "");
  without.replace(without.find("T = "), without.find("k = ") - without.find("T = "), "");
  std::ofstream(copy.path() / "trajectory.toml") << without;
  std::ofstream(copy.path() / "poses.csv") << GetParam().text;
  const std::string message = message_of(copy.path() / "trajectory.toml");
  EXPECT_EQ(message.find((copy.path() / "poses.csv").string() + ": "), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_THAT(message, testing::HasSubstr(", expected "));
  for (const std::string& part : GetParam().message) EXPECT_THAT(message, testing::HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(Loader, BadPosesTest, testing::ValuesIn(kBadTables),
                         [](const auto& test) { return std::string(test.param.name); });

/// A table of poses has a start and a duration of its own.
TEST(BadPoses, TakeNoOtherStartAndDuration) {
  EditedCopy copy;
  follow_poses(copy);
  const std::filesystem::path file = copy.path() / "trajectory.toml";
  EXPECT_THAT(message_of(file),
              testing::HasSubstr("trajectory.toml: pose: got a table, expected "));
  std::string task = read_text(file);
  task.replace(task.find("[pose]"), task.find("[path]") - task.find("[pose]"), "");
  std::ofstream(file) << task;
  EXPECT_THAT(message_of(file), testing::HasSubstr("trajectory.toml: motion.T: got 10, expected "));
  task.replace(task.find("T = "), task.find("k = ") - task.find("T = "), "");
  std::ofstream(file) << task;
  EXPECT_THAT(message_of(file), testing::HasSubstr("poses.csv: file: got an unreadable file"));
}

}  // namespace
}  // namespace maxwrench
