#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "maxwrench/task.h"
#include "tests/support/bad_input.h"
#include "tests/support/edited_copy.h"

// Payloads and tables of wrenches in time that are rejected.

namespace maxwrench {
namespace {

constexpr const char* kTurning = "uvms/valve_trajectory";
constexpr const char* kTurningFile = "valve_trajectory.toml";
constexpr const char* kWrenchTable = "[wrench]\nc = [0, 0, 0, 0, 0, 1]";

const ChangedProblem kBadPayloads[] = {
    {"beside_wrench",
     kTurningFile,
     kWrenchTable,
     "[wrench]\nc = [0, 0, 0, 0, 0, 1]\n[payload]\ncom = [0, 0, 0]",
     {"wrench: got a table", "no such table beside payload"}},
    {"no_com",
     kTurningFile,
     kWrenchTable,
     "[payload]\nvolume_per_kg = 0",
     {"payload.com: got nothing"}},
    {"negative_inertia",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 0]\ninertia_per_kg = [-1, 1, 1, 0, 0, 0]",
     {"payload.inertia_per_kg", "moments >= 0"}},
    {"negative_added_mass",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 0]\nadded_mass_per_kg = [0, -1, 0, 0, 0, 0]",
     {"payload.added_mass_per_kg", "-1"}},
    {"negative_volume",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 0]\nvolume_per_kg = -1e-4",
     {"payload.volume_per_kg: got -0.0001"}},
    {"nan", kTurningFile, kWrenchTable, "[payload]\ncom = [0, nan, 0]", {"payload.com", "nan"}},
    {"absurd_volume",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 0]\nvolume_per_kg = 1e300",
     {"payload: got a wrench of 9.", "e+303 per kg", "at most 1e+09"}},
    {"absurd_com",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 1e300]",
     {"payload.com: got [0, 0, 1e+300]", "at most 1e+09"}},
    {"absurd_added_mass",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 0]\nadded_mass_per_kg = [0, 0, 0, 0, 0, 1e300]",
     {"payload.added_mass_per_kg: got [0, 0, 0, 0, 0, 1e+300]", "at most 1e+09"}},
    {"drag",
     kTurningFile,
     kWrenchTable,
     "[payload]\ncom = [0, 0, 0]\ndamping_linear = [1, 1, 1, 1, 1, 1]",
     {"payload.damping_linear"}},
    {"file_beside_c",
     kTurningFile,
     kWrenchTable,
     "[wrench]\nc = [0, 0, 0, 0, 0, 1]\nfile = \"cutting.csv\"",
     {"wrench.c: got [0, 0, 0, 0, 0, 1]", "no such key beside wrench.file"}},
    {"file_beside_any",
     kTurningFile,
     kWrenchTable,
     "[wrench]\nany = [\"fx\"]\nfile = \"cutting.csv\"",
     {"wrench.any", "no such key beside wrench.file"}},
};

class BadPayloadTest : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadPayloadTest, IsRejectedInOneLine) {
  ChangedProblem input = GetParam();
  expect_rejected(input, kTurning);
}

INSTANTIATE_TEST_SUITE_P(Loader, BadPayloadTest,
                         testing::ValuesIn(std::begin(kBadPayloads), std::end(kBadPayloads)),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadPayload, OfAnImpulse) {
  expect_rejected({"impulse",
                   "valve_impulse.toml",
                   "[wrench]\nc = [0, 0, 0, 0, 0, 1]",
                   "[payload]\ncom = [0, 0, 0]",
                   {"payload: got a table", "impulse"}},
                  "uvms/valve_impulse");
}

const ChangedProblem kBadTransfers[] = {
    {"unknown_joint",
     "lift.toml",
     "q2 = 0\n\n[to]",
     "elbow = 0\n\n[to]",
     {"from.elbow: got an unknown key", "q1, q2"}},
    {"missing_joint",
     "lift.toml",
     "q2 = 0\n\n[motion]",
     "\n[motion]",
     {"to: got 1 joints", "q1, q2"}},
    {"beyond_limit",
     "lift.toml",
     "q2 = 0\n\n[to]",
     "q2 = 3\n\n[to]",
     {"from: got [-1.0", "q2 within"}},
    {"nan", "lift.toml", "q2 = 0\n\n[to]", "q2 = nan\n\n[to]", {"from.q2: got nan"}},
    {"T_zero", "lift.toml", "T = 1.5", "T = 0", {"motion.T: got 0", "> 0"}},
    {"T_negative", "lift.toml", "T = 1.5", "T = -1", {"motion.T: got -1", "> 0"}},
    {"k_two", "lift.toml", "k = 8", "k = 2", {"motion.k: got 2", "3 or more"}},
    {"scheme", "lift.toml", "k = 8", "k = 8\nscheme = \"ends\"", {"motion.scheme"}},
    {"no_payload", "lift.toml", "[payload]\ncom = [0, 0, 0]", "", {"payload: got nothing"}},
    {"wrench",
     "lift.toml",
     "[payload]\ncom = [0, 0, 0]",
     "[payload]\ncom = [0, 0, 0]\n[wrench]\nc = [0, 0, 1, 0, 0, 0]",
     {"wrench: got a table"}},
    {"pose", "lift.toml", "[payload]", "[pose]\nxyz = [0, 0, 0]\n[payload]", {"pose"}},
    {"negative_mass_of_water",
     "lift.toml",
     "[payload]\ncom = [0, 0, 0]",
     "[payload]\ncom = [0, 0, 0]\ninertia_per_kg = [1, 1, 3, 0, 0, 0]",
     {"payload.inertia_per_kg", "none above the sum"}},
};

class BadTransferTest : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadTransferTest, IsRejectedInOneLine) {
  expect_rejected(GetParam(), "../examples/tasks/two_link/lift");
}

INSTANTIATE_TEST_SUITE_P(Loader, BadTransferTest,
                         testing::ValuesIn(std::begin(kBadTransfers), std::end(kBadTransfers)),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadTransfer, OfARobotWhoseBaseMoves) {
  TaskSpec spec;
  spec.robot = load_problem("planar/force").robot;
  spec.end_effector = "tool";
  spec.payload.emplace();
  MotionTask& motion = spec.motion.emplace();
  motion.transfer = true;
  motion.k = 4;
  try {
    make_problem(spec);
    ADD_FAILURE() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("robot: got a base with 3 free axes, expected"));
  }
}

struct BadWrenches {
  const char* name;
  const char* text;
  std::vector<std::string> message;
};

void PrintTo(const BadWrenches& bad, std::ostream* out) { *out << bad.name; }

const BadWrenches kBadWrenches[] = {
    {"missing", nullptr, {"file: got an unreadable file"}},
    {"empty", "", {"rows: got 0", "two wrenches or more"}},
    {"one_row", "0,1,0,0,0,0,0\n", {"rows: got 1", "two wrenches or more"}},
    {"six_columns", "0,1,0,0,0,0\n", {"line 1: got '0,1,0,0,0,0'", "t,fx,fy,fz,tx,ty,tz"}},
    {"other_header", "t,x,y,z,tx,ty,tz\n0,1,0,0,0,0,0\n", {"line 1: got 't,x", "t,fx,fy"}},
    {"nan", "0,1,0,0,0,0,0\n10,nan,0,0,0,0,0\n", {"line 2: got '10,nan", "finite numbers"}},
    {"late", "1,1,0,0,0,0,0\n10,1,0,0,0,0,0\n", {"line 1: got", "t = 0 in the first row"}},
    {"back",
     "0,1,0,0,0,0,0\n5,1,0,0,0,0,0\n4,1,0,0,0,0,0\n10,1,0,0,0,0,0\n",
     {"line 3: got", "rises"}},
};

std::string rejection_of_file(const std::filesystem::path& task) {
  try {
    load_problem(task.string());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// planar/trajectory, which lasts 10 s, with a table of wrenches.
std::filesystem::path with_wrenches(EditedCopy& copy, const char* text) {
  const std::filesystem::path file = copy.path() / "trajectory.toml";
  std::string task = read_text(file);
  const std::size_t wrench = task.find("[wrench]"), next = task.find("\n[", wrench);
  task.replace(wrench, next - wrench, "[wrench]\nfile = \"cutting.csv\"\n");
  std::ofstream(file) << task;
  if (text) std::ofstream(copy.path() / "cutting.csv") << text;
  return file;
}

class BadWrenchesTest : public testing::TestWithParam<BadWrenches> {};

TEST_P(BadWrenchesTest, AreRejectedInOneLineThatNamesTheTable) {
  EditedCopy copy;
  const std::string message = rejection_of_file(with_wrenches(copy, GetParam().text));
  EXPECT_EQ(message.find((copy.path() / "cutting.csv").string() + ": "), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string& part : GetParam().message) EXPECT_THAT(message, testing::HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(Loader, BadWrenchesTest,
                         testing::ValuesIn(std::begin(kBadWrenches), std::end(kBadWrenches)),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadWrenches, WithAnotherSchemeThanTheSpline) {
  EditedCopy copy;
  const std::filesystem::path file = with_wrenches(copy, "0,1,0,0,0,0,0\n10,1,0,0,0,0,0\n");
  copy.replace("trajectory.toml", "scheme = \"spline\"", "scheme = \"forward\"");
  copy.replace("trajectory.toml", "instants_per_interval", "# instants_per_interval");
  EXPECT_THAT(rejection_of_file(file),
              testing::HasSubstr("motion.scheme: got forward, expected spline "
                                 "beside wrench.file"));
}

TEST(BadWrenches, ThatEndAtAnotherTimeOrAreZero) {
  EditedCopy copy;
  const std::filesystem::path file = with_wrenches(copy, "0,1,0,0,0,0,0\n9,1,0,0,0,0,0\n");
  EXPECT_THAT(rejection_of_file(file),
              testing::HasSubstr("wrench.file: got a last t of 9 s, expected "
                                 "the duration of the task, 10 s"));
  std::ofstream(copy.path() / "cutting.csv") << "0,0,0,0,0,0,0\n10,0,0,0,0,0,0\n";
  EXPECT_THAT(rejection_of_file(file),
              testing::HasSubstr("wrench.file: got wrenches of at most 0"));
  std::ofstream(copy.path() / "cutting.csv")
      << "t,fx,fy,fz,tx,ty,tz\n0,1,0,0,0,0,0\n10,2,0,0,0,0,0\n";
  const Problem problem = load_problem(file.string());
  EXPECT_EQ(problem.motion->table->at(5)[0], 1.5);
  EXPECT_STREQ(problem.unit(), "-");
}

}  // namespace
}  // namespace maxwrench
