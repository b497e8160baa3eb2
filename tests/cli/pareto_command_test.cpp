#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(ParetoCommand, WritesTheFront) {
  const TemporaryFolder folder;
  const std::string csv = folder.path() / "f.csv", svg = folder.path() / "f.svg";
  const std::string words = "pareto uvms/valve --against uvms/lift --budget 300 --points 3 ";
  const CommandResult result = run_maxwrench(words + "--out " + csv + " --figure " + svg);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("one posture for all tasks"));
  EXPECT_THAT(read_text(csv), HasSubstr("phi,t,bound,beta_1,beta_2,theta_r.q1_shoulder_yaw"));
  EXPECT_THAT(read_text(svg), HasSubstr("uvms/lift"));
  const json object = json::parse(run_maxwrench(words + "--compromise --json").out);
  EXPECT_EQ(object["points"].size(), 0u);
  EXPECT_GT(object["compromise"]["t"].get<double>(), 0.3);
}

struct BadFront {
  const char *words, *line;
};
void PrintTo(const BadFront& bad, std::ostream* out) { *out << bad.words; }

class BadFrontCommand : public testing::TestWithParam<BadFront> {};

TEST_P(BadFrontCommand, IsOneLine) {
  const CommandResult result = run_maxwrench(std::string("pareto ") + GetParam().words);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(GetParam().line));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadFrontCommand,
    testing::Values(BadFront{"uvms/valve", "--against"},
                    BadFront{"uvms/valve --against planar/force",
                             "--against: got planar/force, expected a static task with the same"},
                    BadFront{"uvms/valve --against uvms/nothing", "uvms/nothing"},
                    BadFront{"uvms/valve --against uvms/lift --points 1", "--points: got '1'"},
                    BadFront{"uvms/valve --against uvms/lift --points 1000000000000",
                             "--points: got '1000000000000', expected a whole number from 2 to"},
                    BadFront{"uvms/valve --against uvms/lift --points 0",
                             "--points: got '0', expected a whole number from 2 to 1000"},
                    BadFront{"uvms/valve --against uvms/lift --gap wide",
                             "--gap: got 'wide', expected a number"},
                    BadFront{"uvms/valve --against uvms/valve_trajectory", "static task"},
                    BadFront{"uvms/valve --against uvms/lift --against-wrench some", "some"},
                    BadFront{"uvms/valve --against uvms/lift --search slp", "search: got 'slp'"}));

}  // namespace
}  // namespace maxwrench
