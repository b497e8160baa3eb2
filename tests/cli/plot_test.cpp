#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

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

/// No step of the experiment succeeds. The answer stands, the figure has nothing to show.
TEST(SimulateCommand, RefusesAFigureWithoutSamples) {
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
