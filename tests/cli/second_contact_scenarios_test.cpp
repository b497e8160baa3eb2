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

constexpr const char* kAnyDead = "[loss]\nany = 1\nactuators = ['thrusters']\n";

/// A folder with the task of the bar and the wall as `task.toml`, with further tables.
class WallTask {
 public:
  explicit WallTask(const std::string& tables, const std::string& file = "bar_wall.toml") {
    const std::string from = MAXWRENCH_SOURCE_DIR "/problems/dual_arm/";
    for (const char* part : {"bar.toml", "bar.urdf"}) {
      std::filesystem::copy(from + part, folder_.path() / part);
    }
    std::ofstream(folder_.path() / "task.toml") << read_text(from + file) << "\n" << tables;
  }
  CommandResult run(const std::string& words) const { return run_maxwrench(words, folder_.path()); }
  json object(const std::string& words) const { return json::parse(run(words + " --json").out); }

 private:
  TemporaryFolder folder_;
};

/// The scenario that decides has the value, with the forces of its own of both contacts.
TEST(SecondContactScenarios, EvalAndSolveSayWhatDecides) {
  const WallTask task(kAnyDead);
  const json at = task.object("eval task.toml --scenarios");
  ASSERT_EQ(at["scenarios"].size(), 9u);
  double least = at["scenarios"][0]["high"];
  std::string decides = at["scenarios"][0]["name"];
  for (const json& each : at["scenarios"]) {
    if (!(each["high"].get<double>() < least)) continue;
    least = each["high"];
    decides = each["name"];
  }
  EXPECT_NEAR(at["beta"], least, 1e-9 * least);
  EXPECT_EQ(at["decides"], decides);
  ASSERT_EQ(at["worst"]["dead"].size(), 1u);
  EXPECT_EQ(decides, at["worst"]["dead"][0].get<std::string>() + " dead");
  ASSERT_EQ(at["h_2"].size(), 6u);
  EXPECT_LE(at["h_2"][1], 0);  // into the wall at y = -0.5 m, or at rest
  const json best = task.object("solve task.toml --seed 1");
  EXPECT_EQ(best["status"], "best_found");
  EXPECT_GT(best["beta"].get<double>(), 1.1 * least);
  EXPECT_EQ(best["worst"]["dead"].size(), 1u);
  EXPECT_FALSE(best["decides"].get<std::string>().empty());
}

TEST(SecondContactScenarios, CertifyProvesAndExplainNamesTheScenario) {
  const WallTask task(kAnyDead);
  const json proof = task.object("certify task.toml");
  EXPECT_EQ(proof["status"], "proven");
  EXPECT_LE(proof["gap"], 1e-3 * (1 + 1e-9));
  const std::string out = task.run("eval task.toml --explain").out;
  EXPECT_THAT(out, HasSubstr("in the scenario that decides, "));
  EXPECT_THAT(task.run("check task.toml").out, HasSubstr("9 limits of actuators"));
}

/// A second arm that exerts nothing leaves the facets, certificates and `verify`.
TEST(SecondContactScenarios, ACertificateWithoutForcesIsVerified) {
  const WallTask task(kAnyDead, "bar_alone.toml");
  const CommandResult proof = task.run("certify task.toml --gap 0.01 --certificate list.proof");
  EXPECT_EQ(proof.exit_status, 0) << proof.err << proof.out;
  const CommandResult checked = task.run("verify list.proof --problem task.toml");
  EXPECT_EQ(checked.exit_status, 0) << checked.err << checked.out;
  EXPECT_THAT(checked.out, HasSubstr("\nverified\n"));
}

struct WallRefusal {
  const char *words, *tables, *line;
};
void PrintTo(const WallRefusal& refusal, std::ostream* out) { *out << refusal.words; }

class SecondContactRefusals : public testing::TestWithParam<WallRefusal> {};

TEST_P(SecondContactRefusals, AreOneLine) {
  const CommandResult result = WallTask(GetParam().tables).run(GetParam().words);
  EXPECT_EQ(result.exit_status, 2) << result.out;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(GetParam().line));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, SecondContactRefusals,
    testing::Values(
        WallRefusal{"eval task.toml --solver facets", kAnyDead, "second contact"},
        WallRefusal{"sensitivity task.toml", kAnyDead,
                    "a task with a second contact, expected a static task with one contact"},
        WallRefusal{"simulate task.toml", kAnyDead, "expected one without a second contact"},
        WallRefusal{"certify task.toml --certificate x.proof", kAnyDead,
                    "--certificate: got a list with forces of a second contact"},
        WallRefusal{"certify task.toml --wrench any", kAnyDead, "wrench: got 'any', expected pure"},
        WallRefusal{"certify task.toml", "[loss]\nany = 2\nactuators = ['thrusters', 'joints']\n",
                    "certify: got forces of a second contact with many scenarios, expected at most "
                    "64 of them"},
        WallRefusal{"eval task.toml", "[environment]\ncurrent = [0.3, 0, 0]\n",
                    "environment.current: got [0.3, 0, 0], expected zero beside [contact]"},
        WallRefusal{"eval task.toml", "[uncertainty]\ncurrent = { speed = 0.3, directions = 8 }\n",
                    "uncertainty.current: got a value, expected no such key beside [contact]"}));

}  // namespace
}  // namespace maxwrench
