#include "cli/ctrl_c.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// Runs a command that would take minutes and sends it SIGINT after a second, or `seconds`.
CommandResult interrupt(const std::string& words, const std::filesystem::path& folder,
                        const std::string& seconds = "1") {
  return run_maxwrench("--version > /dev/null; timeout --foreground --preserve-status -s INT " +
                           seconds + " '" MAXWRENCH_COMMAND "' " + words,
                       folder);
}

/// The answer to a command that is interrupted once it has found a value. How long that takes
/// depends on the machine, so it gets more time if it has found none.
json interrupted_answer(const std::string& words, const std::filesystem::path& folder) {
  json answer;
  for (const char* seconds : {"1", "5", "25"}) {
    const CommandResult result = interrupt(words, folder, seconds);
    EXPECT_EQ(result.exit_status, 1) << result.err;
    EXPECT_EQ(result.err, "");
    answer = json::parse(result.out);
    if (answer["beta"].is_number()) break;
  }
  return answer;
}

TEST(CtrlC, SolvePrintsTheBestSoFar) {
  const TemporaryFolder folder;
  for (const SearchEntry& search : searches()) {
    const std::string name = search.name;
    if (name == "nullspace" || name == "multistart") continue;  // end by themselves, soon
    if (kSanitized && name != "cmaes") continue;
    SCOPED_TRACE(search.name);
    const json best = interrupted_answer(
        "solve uvms/valve --json --budget 10000000 --search " + name, folder.path());
    ASSERT_TRUE(best["beta"].is_number()) << best;
    EXPECT_EQ(best["status"], "budget_exhausted");
    EXPECT_EQ(best["reason"], "interrupted");
    EXPECT_GT(best["evaluations"], 0);
    EXPECT_LT(best["evaluations"], 10000000);
    // Its posture has its value.
    std::string theta_r;
    for (const json& angle : best["theta_r"])
      theta_r += (theta_r.empty() ? "" : ",") + angle.dump();
    const json again =
        json::parse(run_maxwrench("eval uvms/valve --json --theta-r=" + theta_r).out);
    EXPECT_NEAR(again["beta"], best["beta"], 1e-9);
  }
}

TEST(CtrlC, TheTextSaysSo) {
  const TemporaryFolder folder;
  const CommandResult result = interrupt("solve uvms/valve --budget 3000000", folder.path());
  EXPECT_EQ(result.exit_status, 1) << result.err;
  EXPECT_NE(result.out.find("budget_exhausted: interrupted"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\nbeta "), std::string::npos) << result.out;
}

/// A hold of a thousand seconds takes most of a minute.
TEST(CtrlC, SimulatePrintsWhatItHas) {
  const TemporaryFolder folder;
  const CommandResult result =
      interrupt("simulate uvms/valve --hold 1000 --json --out samples.csv", folder.path());
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const json run = json::parse(result.out);
  EXPECT_EQ(run["status"], "budget_exhausted");
  EXPECT_EQ(run["reason"], "interrupted");
  EXPECT_EQ(run["held"], false);
  EXPECT_LT(run["end"], 1000);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "samples.csv"));
}

/// What the interrupted experiment would have shown is not known, so it counts as neither.
TEST(CtrlC, TheHeaviestLoadSoFar) {
  const TemporaryFolder folder;
  const CommandResult result =
      interrupt("simulate uvms/lift --heaviest --hold 1000 --json", folder.path());
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const json load = json::parse(result.out);
  EXPECT_EQ(load["status"], "budget_exhausted");
  EXPECT_EQ(load["reason"], "interrupted");
  EXPECT_GE(load["heaviest"], 0);
}

/// The first is a wish, the second ends the program as if nobody listened.
TEST(CtrlC, TheSecondEndsAtOnce) {
  EXPECT_EXIT(
      {
        std::signal(SIGINT, SIG_DFL);  // a job in the background would ignore it
        const CtrlC ctrl_c;
        std::raise(SIGINT);
        if (!ctrl_c.asked()()) std::exit(1);
        std::raise(SIGINT);
        std::exit(2);
      },
      testing::KilledBySignal(SIGINT), "");
}

/// Half a comparison is printed and kept nowhere: each of its lines depends on the best of all.
TEST(CtrlC, ComparePrintsWhatItHas) {
  const TemporaryFolder folder;
  const CommandResult result = interrupt(
      "compare uvms/valve planar/force --budget 3000000 --seeds 1 --out .", folder.path(), "2");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  EXPECT_NE(result.out.find("uvms/valve, interrupted: best known "), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("\nfacet_sqp+cmaes*"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("planar/force"), std::string::npos) << result.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "search_comparison.csv.gz"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "search_comparison.svg"));
}

}  // namespace
}  // namespace maxwrench
