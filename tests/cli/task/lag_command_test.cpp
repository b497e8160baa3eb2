#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/edited_copy.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// The option and the key of the task are one.
TEST(LagCommand, TheOptionReplacesTheKeyOfTheTask) {
  EditedCopy copy;
  copy.replace("trajectory.toml", "k = 8", "k = 8\nthruster_lag = 2.5");
  const auto value = [&](const std::string& words) {
    const CommandResult result = run_maxwrench("eval " + words + " --json", copy.path());
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return json::parse(result.out);
  };
  const json by_key = value("trajectory.toml");
  const json by_option = value("planar/trajectory --thruster-lag 2.5");
  const json none = value("trajectory.toml --thruster-lag 0");
  EXPECT_EQ(by_key["value"], by_option["value"]);
  EXPECT_EQ(by_key["task"]["thruster_lag"], 2.5);
  EXPECT_FALSE(none["task"].contains("thruster_lag"));
  EXPECT_LE(by_key["value"].get<double>(), none["value"].get<double>());
  EXPECT_EQ(none["value"], value("planar/trajectory")["value"]);
  EXPECT_NE(run_maxwrench("check trajectory.toml", copy.path()).out.find("lag of thrusters 2.5 s"),
            std::string::npos);
}

TEST(LagCommand, RejectsAKeyThatIsNoTimeConstant) {
  for (const char* wrong : {"-0.1", "nan", "inf", "1e9", "\"slow\"", "true"}) {
    EditedCopy copy;
    copy.replace("trajectory.toml", "k = 8", std::string("k = 8\nthruster_lag = ") + wrong);
    const CommandResult result = run_maxwrench("check trajectory.toml", copy.path());
    EXPECT_EQ(result.exit_status, 2) << wrong;
    EXPECT_NE(result.err.find("thruster_lag"), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

/// The proof is of the commands as well: where the lag is large, less is proven than without it.
TEST(LagCommand, AProofKeepsTheLimitsOfCommands) {
  const auto proven = [](const std::string& lag) {
    const CommandResult result =
        run_maxwrench("certify planar/trajectory --theta-r 0.3,0.1 --json --thruster-lag " + lag);
    EXPECT_EQ(result.exit_status, 0) << result.err;
    const json object = json::parse(result.out);
    EXPECT_EQ(object["status"], "proven");
    const double guaranteed = object["guaranteed"];
    EXPECT_LE(guaranteed, object["value_between_knots"].get<double>());
    return guaranteed;
  };
  EXPECT_LT(proven("5"), proven("0"));
}

TEST(LagCommand, SLOW_TheTankRequestsWhatThrustersReach) {
  const CommandResult result = run_maxwrench("simulate planar/trajectory --invert-lag --json");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json object = json::parse(result.out);
  EXPECT_EQ(object["held"], true);
  EXPECT_LT(object["violation"].get<double>(), 1e-6);
}

TEST(LagCommand, SLOW_TheBestThatTheTankHoldsIsWritten) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "solve planar/trajectory --worth tank --simulations 3 --budget 200 --out best.csv --json",
      folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json object = json::parse(result.out);
  EXPECT_EQ(object["status"], "best_found");
  EXPECT_EQ(object["tank"]["held"], true);
  EXPECT_LE(object["tank"]["simulations"].get<int>(), 3);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "best.csv"));
}

}  // namespace
}  // namespace maxwrench
