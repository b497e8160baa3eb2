#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// An angle beyond the joint's limits is no posture; another one in its place would mislead.
TEST(PlotCommand, DrawsNoPostureThatDoesNotExist) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_maxwrench("plot planar/force --theta-r 9,9 --out a.svg", folder.path());
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.err,
            "invalid_posture: joint limit: shoulder at 9 rad, limits -1.0472 .. 1.0472\n");
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.svg"));
}

/// At the start, in the middle and at the end; of an impulse at its peak.
TEST(PlotCommand, DrawsThePosturesOfATrajectory) {
  const TemporaryFolder folder;
  for (const auto& [words, titles] :
       {std::pair("plot uvms/valve_trajectory --style outline", std::array{"0°", "90°", "180°"}),
        std::pair("plot uvms/valve_impulse --style outline --t-h 2",
                  std::array{"0 s", "1.25 s", "2.5 s"})}) {
    const CommandResult result = run_maxwrench(words);
    ASSERT_EQ(result.exit_status, 0) << result.err;
    for (const char* title : titles) {
      for (const char* view : {", from above", ", from the right"})
        EXPECT_NE(result.out.find(">" + std::string(title) + view + "<"), std::string::npos)
            << words << title;
    }
  }
  std::ofstream(folder.path() / "t.csv") << "0,0\n0.1,0\n0.2,0\n9,0\n9,0\n9,0\n9,0\n9,0\n";
  const std::string words = "plot planar/trajectory --theta-r t.csv --out ";
  const CommandResult beyond = run_maxwrench(words + "a.svg", folder.path());
  EXPECT_EQ(beyond.exit_status, 1);
  EXPECT_TRUE(beyond.err.starts_with("invalid_posture: ")) << beyond.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.svg"));
  EXPECT_EQ(run_maxwrench(words + "t.csv", folder.path()).exit_status, 2);
}

/// The value in the caption is the one that `solve` prints, with four digits.
TEST(PlotCommand, SLOW_TheBestPostureIsThatOfSolve) {
  for (const char* words : {"planar/force --search grid+cmaes --budget 500 --seed 3", "fixed/push",
                            "uvms/lift --search cmaes --budget 300 --measure "
                            "ellipsoid"}) {
    const CommandResult solved = run_maxwrench("solve --json " + std::string(words));
    ASSERT_EQ(solved.exit_status, 0) << solved.err;
    const auto answer = nlohmann::json::parse(solved.out);
    const CommandResult result = run_maxwrench("plot --best " + std::string(words));
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const double beta = answer["beta"];
    const int decimals = 3 - static_cast<int>(std::floor(std::log10(beta)));
    char value[32];
    std::snprintf(value, sizeof value, "%.*f", decimals, beta);
    EXPECT_NE(result.out.find(">\u03b2 = " + std::string(value) + " "), std::string::npos)
        << words << value;
    EXPECT_NE(result.out.find(">default posture<"), std::string::npos);
    EXPECT_NE(result.out.find(">best posture<"), std::string::npos);
  }
}

TEST(PlotCommand, OutlinesOfTheBestPostureAreBesideTheDefault) {
  const CommandResult result =
      run_maxwrench("plot planar/force --best --budget 300 --style outline");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  for (const char* text : {">default<", ">best<", "ellipsoid"}) {
    EXPECT_NE(result.out.find(text), std::string::npos) << text;
  }
}

TEST(PlotCommand, StillsAreEvenlyOverTime) {
  const CommandResult result = run_maxwrench("plot planar/trajectory --stills 5");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  for (const char* time : {"0", "2.5", "5", "7.5", "10"}) {
    EXPECT_NE(result.out.find(">t = " + std::string(time) + " s<"), std::string::npos) << time;
  }
}

/// Given beside best: the given one is drawn though it does not exist, and the picture says so.
TEST(PlotCommand, SaysThatAPostureBesideTheBestDoesNotExist) {
  const CommandResult result = run_maxwrench("plot planar/force --theta-r 9,9 --best --budget 300");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find(">given posture<"), std::string::npos);
  EXPECT_NE(result.out.find("joint limit: shoulder at 9 rad"), std::string::npos);
}

TEST(PlotCommand, RejectsBadInputInOneLine) {
  for (const char* words :
       {"--style round", "--style", "--stills 0", "--stills 9", "--stills 3", "--search cmaes",
        "--budget 100", "--seed 2", "--best --search none", "--best --budget 0", "--measure none",
        "--best --scheme ends", "--out ''"}) {
    const CommandResult result = run_maxwrench("plot planar/force " + std::string(words));
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << words << result.err;
    EXPECT_EQ(result.out, "") << words;
  }
  const CommandResult outline =
      run_maxwrench("plot planar/trajectory --style outline --best --budget 20");
  EXPECT_EQ(outline.exit_status, 2);
  EXPECT_EQ(outline.err.find("maxwrench: --style: got outline with --best"), 0U) << outline.err;
}

/// No step of the experiment succeeds. The answer stands, the figure has nothing to show.
TEST(SimulateCommand, RejectsAFigureWithoutSamples) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "simulate uvms/valve --thrust-noise 1e300 --figure a.svg --json", folder.path());
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.out.find("\"held\":false"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("figure: got no sample of uvms/valve"), std::string::npos);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.svg"));
}

}  // namespace
}  // namespace maxwrench
