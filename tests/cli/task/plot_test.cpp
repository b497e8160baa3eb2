#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

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
       {std::pair("plot uvms/valve_trajectory", std::array{"0°", "90°", "180°"}),
        std::pair("plot uvms/valve_impulse --t-h 2", std::array{"0 s", "1.25 s", "2.5 s"})}) {
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
