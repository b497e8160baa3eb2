#include <gtest/gtest.h>

#include <cstdlib>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// MAXWRENCH_PROBLEMS as long as this lives.
class ProblemsVariable {
 public:
  explicit ProblemsVariable(const fs::path& folder) {
    setenv("MAXWRENCH_PROBLEMS", folder.c_str(), 1);
  }
  ~ProblemsVariable() { unsetenv("MAXWRENCH_PROBLEMS"); }
  ProblemsVariable(const ProblemsVariable&) = delete;
  ProblemsVariable& operator=(const ProblemsVariable&) = delete;
};

TEST(ProblemsFolder, IsThatOfTheSourcesWhereNothingIsInstalled) {
  unsetenv("MAXWRENCH_PROBLEMS");
  EXPECT_EQ(problems_folder(), fs::canonical(fs::path(MAXWRENCH_SOURCE_DIR) / "problems"));
  const ProblemsVariable empty("");
  EXPECT_EQ(problems_folder(), fs::canonical(fs::path(MAXWRENCH_SOURCE_DIR) / "problems"));
}

TEST(ProblemsFolder, TheVariableComesFirst) {
  const TemporaryFolder folder;
  fs::copy(fs::path(MAXWRENCH_SOURCE_DIR) / "problems/fixed", folder.path() / "own");
  const ProblemsVariable variable(folder.path());
  EXPECT_EQ(shipped_problems(), std::vector<std::string>{"own/push"});
  EXPECT_EQ(load_problem("own/push").robot.joints.size(), 7U);
  EXPECT_THROW(load_problem("planar/force"), std::invalid_argument);
}

/// One broken file does not hide the others.
TEST(ProblemsFolder, ALinkThatLeadsToItselfIsNoProblem) {
  const TemporaryFolder folder;
  fs::copy(fs::path(MAXWRENCH_SOURCE_DIR) / "problems/fixed", folder.path() / "own");
  fs::create_symlink("loop.toml", folder.path() / "own" / "loop.toml");
  const ProblemsVariable variable(folder.path());
  EXPECT_EQ(shipped_problems(), std::vector<std::string>{"own/push"});
}

/// Not what std::filesystem throws there.
TEST(ProblemsFolder, ALinkThatLeadsToItselfIsBadInput) {
  const TemporaryFolder folder;
  const fs::path circle = folder.path() / "circle";
  fs::create_symlink("circle", circle);
  const Problem problem = load_problem("planar/force");
  EXPECT_THROW(load_problem(circle.string()), std::invalid_argument);
  EXPECT_THROW(load_robot(circle), std::invalid_argument);
  EXPECT_THROW(is_task(circle), std::invalid_argument);
  EXPECT_THROW(load_knots(circle, problem), std::invalid_argument);
  EXPECT_THROW(load_state(circle, problem.robot), std::invalid_argument);
  EXPECT_TRUE(tasks_in(circle).empty());
  const ProblemsVariable variable(circle);
  EXPECT_THROW(problems_folder(), std::invalid_argument);
}

/// 255 letters are a name of a file; as the name of a problem it would get five more.
TEST(ProblemsFolder, LongFileNamesAreFiles) {
  const TemporaryFolder folder;
  fs::copy(fs::path(MAXWRENCH_SOURCE_DIR) / "problems/fixed", folder.path() / "own");
  const fs::path task = folder.path() / "own" / (std::string(250, 'a') + ".toml");
  fs::rename(folder.path() / "own" / "push.toml", task);
  EXPECT_EQ(load_problem(task.string()).robot.joints.size(), 7U);
}

TEST(ProblemsFolder, AWrongVariableIsBadInput) {
  const ProblemsVariable variable("/proc/nowhere");
  for (const char* words : {"list", "eval planar/force"}) {
    const CommandResult result = run_maxwrench(words);
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_EQ(result.err,
              "maxwrench: MAXWRENCH_PROBLEMS: got '/proc/nowhere', expected a folder with "
              "problems\n");
  }
}

}  // namespace
}  // namespace maxwrench
