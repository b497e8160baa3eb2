#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

json explained(const std::string& words) {
  const CommandResult result = run_maxwrench(words + " --explain --json");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
  return json::parse(result.out);
}

TEST(ExplainCommand, PrintsTheAnswerFirst) {
  const CommandResult plain = run_maxwrench("eval uvms/lift");
  const CommandResult with = run_maxwrench("eval uvms/lift --explain");
  EXPECT_EQ(with.exit_status, 0) << with.err;
  const std::string head = plain.out.substr(0, plain.out.find("residual"));
  EXPECT_EQ(with.out.substr(0, head.size()), head);
  for (const char* line :
       {"\nbinds: front_right_vertical and front_left_vertical are at their lower limits\n",
        "\n10 % more of front_right_vertical adds 0.56982 N\n", "\nweight ", "\nbuoyancy ",
        "\nsum: beta ", "\nposture optimised again: no rates, ", "\nleast efforts: |W_u u| "}) {
    EXPECT_NE(with.out.find(line), std::string::npos) << line << with.out;
  }
  EXPECT_EQ(plain.out.find("binds"), std::string::npos);
}

TEST(ExplainCommand, AddsAKeyToTheJson) {
  const json object = explained("eval uvms/lift --share 0.5");
  EXPECT_NEAR(object["beta"], 29.92061, 1e-5);
  const json& what = object["explanation"];
  EXPECT_TRUE(what["missing"].is_null());
  ASSERT_EQ(what["binding"].size(), 2U);
  double sum = 0;
  for (const json& limit : what["binding"]) {
    EXPECT_THAT(limit["actuator"].get<std::string>(), testing::StartsWith("front_"));
    EXPECT_EQ(limit["limit"], "min");
    EXPECT_EQ(limit["at"], -40);
    EXPECT_NEAR(limit["rate"], -0.38410, 5e-6);
    EXPECT_NEAR(limit["down"], 1.48353, 5e-6);
    sum += limit["share"].get<double>();
  }
  for (const char* load : {"weight", "buoyancy", "trim", "other", "error"}) {
    sum += what["budget"][load].get<double>();
  }
  EXPECT_NEAR(sum, object["beta"], 1e-9);
  EXPECT_EQ(what["least_efforts"]["share"], 0.5);
  EXPECT_EQ(what["least_efforts"]["u"].size(), 12U);
  EXPECT_FALSE(what["best_posture"]["missing"].is_null());
  EXPECT_FALSE(json::parse(run_maxwrench("eval uvms/lift --json").out).contains("explanation"));
}

TEST(ExplainCommand, SLOW_OfSolveHasRatesOfTheBestPosture) {
  const json what = explained("solve uvms/valve")["explanation"];
  EXPECT_TRUE(what["best_posture"]["missing"].is_null());
  EXPECT_LT(what["best_posture"]["residual"], 1e-6);
  const json& first = what["best_posture"]["limits"][0];
  EXPECT_EQ(first["name"], "front_right_vertical");
  EXPECT_NEAR(first["rate"], -0.4173, 5e-5);
}

TEST(ExplainCommand, OfATaskInTimeListsInstants) {
  const json what = explained("eval planar/trajectory")["explanation"];
  EXPECT_TRUE(what["missing"].is_null());
  EXPECT_FALSE(what["instants"].empty());
  EXPECT_EQ(what["least_efforts"]["missing"], "the task is in time");
  EXPECT_TRUE(what["budget"].is_null());
}

TEST(ExplainCommand, WithoutAValueSaysWhyInOneLine) {
  const CommandResult result = run_maxwrench("eval uvms/valve --theta-r 0,0,0,0 --explain");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.out.find("\nbinds: not known, there is no value: "), std::string::npos)
      << result.out;
}

TEST(ExplainCommand, RejectsBadInputInOneLine) {
  for (const char* words :
       {"eval planar/force --share 0.5", "eval planar/force --explain --share 1.5",
        "eval planar/force --explain --share -0.1", "eval planar/force --explain --share nan",
        "eval planar/force --explain --share much", "eval planar/force --explain --share",
        "solve planar/force --share 0.5 --budget 10",
        "eval uvms/valve --state problems/uvms/state_example.toml --explain"}) {
    const CommandResult result = run_maxwrench(words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(result.out, "") << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.find("share") != std::string::npos ||
                result.err.find("explain") != std::string::npos)
        << result.err;
  }
}

}  // namespace
}  // namespace maxwrench
