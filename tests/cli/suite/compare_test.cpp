#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/edited_copy.h"
#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

TEST(Compare, RejectsAProblemTwice) {
  const CommandResult result = run_maxwrench("compare planar/force uvms/lift planar/force");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.err.find("problems: got 'planar/force' twice"), std::string::npos) << result.err;
}

/// A closed form has no use for GLPK, so there is nothing to relate times to.
TEST(Compare, OfAClosedFormHasNoReference) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "compare planar/force --measure ellipsoid --budget 50 --seeds 1 --out .", folder.path());
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.out.find("glpk"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\nnullspace           none "), std::string::npos) << result.out;
}

/// 25 m away nothing is reached: no value, no number.
TEST(Compare, SaysThatNothingHasAValue) {
  EditedCopy copy;
  copy.replace("two_arms.toml", "xyz = [-0.02, -0.25, 0]", "xyz = [-0.02, -25, 0]");
  const CommandResult result =
      run_maxwrench("compare two_arms.toml --budget 20 --seeds 2 --out .", copy.path());
  EXPECT_EQ(result.exit_status, 1) << result.err;
  EXPECT_NE(result.out.find("best known - N"), std::string::npos) << result.out;
  EXPECT_NE(
      result.out.find("\ngrid                condensed          20   0 of 2         -       - "),
      std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find("2 of 2"), std::string::npos) << result.out;
  for (const char* word : {"inf ", "nan", "inf,"}) {
    EXPECT_EQ(result.out.find(word), std::string::npos) << result.out;
    EXPECT_EQ(read_table(copy.path() / "search_comparison.csv").find(word), std::string::npos);
  }
}

TEST(Compare, SLOW_WritesTheSameValuesAgain) {
  std::string first;
  for (int run = 0; run < 2; ++run) {
    const TemporaryFolder folder;
    const CommandResult result =
        run_maxwrench("compare planar/force --budget 300 --seeds 2 --out .", folder.path());
    ASSERT_EQ(result.exit_status, 0) << result.err;
    EXPECT_NE(result.out.find("nullspace"), std::string::npos);
    const std::string values = read_table(folder.path() / "search_comparison.csv");
    EXPECT_GT(std::count(values.begin(), values.end(), '\n'), 18);
    EXPECT_NE(read_text(folder.path() / "search_comparison.svg").find("<polyline"),
              std::string::npos);
    for (const char* file :
         {"search_times.csv.gz", "search_ecdf.svg", "search_ecdf_problems.svg"}) {
      EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
    }
    EXPECT_NE(values.find(",evaluations_to_ten_thousandth,"), std::string::npos) << values;
    if (run == 0) first = values;
    EXPECT_EQ(values, first);
  }
}

/// Searches that support both problems stand before those that support one; each line has as many
/// cells as the head.
TEST(Compare, SLOW_SumsUpOverAllProblems) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_maxwrench("compare planar/force uvms/lift --budget 500 --seeds 1 --out .", folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(read_text(folder.path() / "search_comparison.txt"), result.out);
  const std::size_t all = result.out.find(
      "\n| search | typical | worst | 10 % | 1 % | 0.1 % | 0.01 % "
      "| planar/force | uvms/lift |\n");
  ASSERT_NE(all, std::string::npos) << result.out;
  std::istringstream lines(result.out.substr(all + 1));
  std::string line;
  int rows = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 10) << line;
    ++rows;
  }
  EXPECT_GT(rows, 20);
  const std::size_t some = result.out.find("\n| search | typical | worst |");
  EXPECT_LT(some, all);
  const std::string leaders = result.out.substr(some, all - some);
  EXPECT_NE(leaders.find("\n| **`facet_sqp+cmaes`** |"), std::string::npos) << leaders;
  EXPECT_NE(leaders.find("\n| `sample` |"), std::string::npos) << leaders;
}

}  // namespace
}  // namespace maxwrench
