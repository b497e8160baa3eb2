#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kUnfold =
    "margin uvms/valve_trajectory --motion examples/motions/unfold_while_turning.csv ";

TEST(MarginCommand, WritesTableAndFigure) {
  const TemporaryFolder folder;
  const std::string csv = folder.path() / "m.csv", svg = folder.path() / "m.svg";
  const CommandResult result =
      run_maxwrench(std::string(kUnfold) + "--out " + csv + " --figure " + svg);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("velocities and accelerations of a cubic spline"));
  EXPECT_THAT(result.out, HasSubstr("the least of 41 instants from 0 to 5 s"));
  const std::string table = read_text(csv);
  EXPECT_THAT(table,
              testing::StartsWith("t,margin,status,fx,fy,fz,tx,ty,tz,facet,binding,limits\n"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 42);
  EXPECT_THAT(read_text(svg), HasSubstr("any direction of fx fy fz"));
}

/// More directions leave less, and instants between the rows contain the rows.
TEST(MarginCommand, SetsAndInstantsAreNested) {
  const auto least = [](const std::string& options) {
    const CommandResult result = run_maxwrench(std::string(kUnfold) + "--json " + options);
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return json::parse(result.out)["margin"].get<double>();
  };
  const double any = least("");
  EXPECT_LE(any, least("--ball fx,fy"));
  EXPECT_LE(least("--ball fx,fy"), least("--ball fx"));
  EXPECT_LE(least("--instants-per-interval 5"), any);
  EXPECT_NEAR(any, least("--ball-frame end_effector"), 1e-9);  // a ball has no axes
}

/// The trajectory of the task itself, with the torque of the task: its value is the least of the
/// instants, as the rates of its efforts do not bind.
TEST(MarginCommand, AcceptsOurOwnTrajectories) {
  const std::string table = "results/trajectories/uvms_valve_trajectory_spline.csv";
  const json margin = json::parse(
      run_maxwrench("margin uvms/valve_trajectory --task-wrench --json --theta-r " + table).out);
  const json value =
      json::parse(run_maxwrench("eval uvms/valve_trajectory --json --theta-r " + table).out);
  EXPECT_NEAR(margin["margin"], value["value"], 1e-6);
  EXPECT_EQ(margin["unit"], "N m");
  EXPECT_LT(margin["difference"].get<double>(), 1e-7);
}

/// A swing in a hundredth of the time needs more than any motor has.
TEST(MarginCommand, AnInfeasibleMotionIsNegative) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "swing.csv";
  std::ofstream(file) << "t,shoulder,elbow\n0,-0.8,1\n0.02,-0.7,1.1\n0.04,-0.4,1.4\n0.06,0,1.8\n";
  const std::string words = "margin planar/force --ball fx,fy --motion " + file;
  const CommandResult result = run_maxwrench(words);
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.out, HasSubstr("infeasible: the motion itself needs more"));
  const json object = json::parse(run_maxwrench(words + " --json").out);
  EXPECT_LT(object["margin"].get<double>(), 0);
  EXPECT_GT(object["infeasible"].get<int>(), 0);
  EXPECT_TRUE(object["worst"]["by_program"].is_null());
}

struct BadMargin {
  const char *words, *line;
};
void PrintTo(const BadMargin& bad, std::ostream* out) { *out << bad.words; }

class BadMarginCommand : public testing::TestWithParam<BadMargin> {};

TEST_P(BadMarginCommand, IsOneLine) {
  const CommandResult result = run_maxwrench(std::string("margin ") + GetParam().words);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(GetParam().line));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMarginCommand,
    testing::Values(
        BadMargin{"uvms/valve", "--motion: got nothing, expected a table of a motion"},
        BadMargin{"uvms/valve --motion nothing.csv", "nothing.csv"},
        BadMargin{"uvms/valve --motion problems/uvms/valve.toml", "problems/uvms/valve.toml: "},
        BadMargin{"planar/force --motion examples/motions/unfold_while_turning.csv",
                  "columns: got q1_shoulder_yaw, expected one of shoulder, elbow"},
        BadMargin{"uvms/valve_trajectory --ball fx,tx", "--ball: got fx tx"},
        BadMargin{"uvms/valve_trajectory --ball up", "--ball: got up"},
        BadMargin{"uvms/valve_trajectory --ball-frame tool", "--ball-frame"},
        BadMargin{"uvms/valve_trajectory --ball fx --task-wrench", "--task-wrench"},
        BadMargin{"uvms/valve_trajectory --instants-per-interval 2", "--motion"},
        BadMargin{"uvms/valve_trajectory --theta-r 9,9,9,9",
                  "--theta-r: got an invalid trajectory"},
        BadMargin{"uvms/valve_trajectory --motion examples/motions/unfold_while_turning.csv "
                  "--instants-per-interval 0",
                  "--instants-per-interval: got '0', expected a whole number from 1 to"},
        BadMargin{"examples/tasks/turn_guaranteed.toml --motion "
                  "examples/motions/unfold_while_turning.csv",
                  "uncertainty: got uncertain loads"},
        BadMargin{"planar/two_arms --motion examples/motions/unfold_while_turning.csv",
                  "contact: got a second contact"}));

}  // namespace
}  // namespace maxwrench
