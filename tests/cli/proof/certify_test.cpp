#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/support/snake.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

TEST(CertifyCommand, Proves) {
  const CommandResult result = run_maxwrench("certify planar/force --gap 1e-4 --json");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const json proof = json::parse(result.out);
  EXPECT_EQ(proof["status"], "proven");
  EXPECT_EQ(proof["reason"], "");
  EXPECT_EQ(proof["measure"], "linf_polytope");
  const double beta = proof["beta"], bound = proof["bound"], gap = proof["gap"];
  EXPECT_GE(bound, beta);
  EXPECT_LE(gap, 1.0001e-4);
  EXPECT_NEAR(gap, (bound - beta) / beta, 1e-12);
  EXPECT_GT(proof["boxes"], 10);
  EXPECT_LT(proof["residual"]["gap"], 1e-9);
  const json best = json::parse(run_maxwrench("solve planar/force --json").out);
  EXPECT_NEAR(proof["beta"], best["beta"], 1e-6);
}

TEST(CertifyCommand, SLOW_ProvesWhereJointsFollow) {
  for (const char* name : {"mobile/push", "dual_arm/bar_wall"}) {
    const CommandResult result = run_maxwrench(std::string("certify --json ") + name);
    EXPECT_EQ(result.exit_status, 0) << result.err;
    EXPECT_LE(json::parse(result.out)["gap"], 1.0001e-3);
  }
}

TEST(CertifyCommand, SaysWhatItProves) {
  const CommandResult result =
      run_maxwrench("certify planar/force --measure ellipsoid --ignore-collision");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  for (const char* text : {"planar/force  measure ellipsoid  wrench pure  collisions ignored\n",
                           "\nproven\n", "\nbeta ", ": no posture has more\n", "\ngap  "}) {
    EXPECT_NE(result.out.find(text), std::string::npos) << text << " in\n" << result.out;
  }
}

/// Without time there is a bracket all the same.
TEST(CertifyCommand, PrintsABracket) {
  const CommandResult result = run_maxwrench("certify uvms/valve --time 0 --json");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const json proof = json::parse(result.out);
  EXPECT_EQ(proof["status"], "bracket");
  EXPECT_EQ(proof["reason"], "the time ran out");
  EXPECT_GT(proof["bound"], proof["beta"]);
  EXPECT_GT(proof["gap"], proof["asked"]);
}

/// Where nothing has a value, that is what is proven, and no bound is missing. Arms that are too
/// weak to hold themselves up.
TEST(CertifyCommand, ProvesThatNothingHasAValue) {
  const Snake snake(2);
  const std::string urdf = snake.path() / "robot.urdf";
  const std::string text = read_text(urdf);
  std::ofstream(urdf) << std::regex_replace(text, std::regex("effort=\"9\""), "effort=\"0.001\"");
  const CommandResult result = run_maxwrench("certify " + snake.task());
  EXPECT_NE(result.out.find("\nproven: no posture has a value\nboxes "), std::string::npos)
      << result.out;
}

/// A program with a sanitizer may need more than a second to begin.
TEST(CertifyCommand, EndsWithCtrlC) {
  const std::string seconds = kSanitized ? "8" : "1";
  const CommandResult result = run_maxwrench(
      "--version > /dev/null; timeout --foreground --preserve-status -s INT " + seconds +
      " '" MAXWRENCH_COMMAND "' certify uvms/lift --measure ellipsoid --gap 1e-8 --json");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const json proof = json::parse(result.out);
  EXPECT_EQ(proof["status"], "bracket");
  EXPECT_EQ(proof["reason"], "interrupted");
  EXPECT_GT(proof["bound"], proof["beta"]);
}

TEST(CertifyCommand, RejectsInOneLine) {
  const auto rejected = [](const std::string& words, const char* mention) {
    const CommandResult result = run_maxwrench("certify " + words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(mention), std::string::npos) << result.err;
  };
  rejected("mobile/trajectory", "for a bound on trajectories");
  rejected("mobile/trajectory --theta-r 2.3,-2 --wrench any", "for a proof in time");
  rejected("dual_arm/bar_wall --measure ellipsoid", "got 'ellipsoid'");
  rejected("dual_arm/bar_alone --wrench any", "second contact");
  rejected("planar/force --measure volume", "--measure: got 'volume'");
  rejected("planar/force --measure ellipsoid --wrench any", "--wrench: got 'any'");
  rejected("planar/force --gap 1e-9", "--gap");
  rejected("planar/force --time soon", "--time");
}

}  // namespace
}  // namespace maxwrench
