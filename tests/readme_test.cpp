#include <gtest/gtest.h>

#include <sstream>

#include "tests/support.h"

namespace maxwrench {
namespace {

/// The words behind `$ build/maxwrench` in the console blocks of a document.
std::vector<std::string> commands(const std::string& file) {
  static const std::string kPrompt = "$ build/maxwrench ";
  std::vector<std::string> words;
  std::istringstream text(read_text(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / file));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(kPrompt)) words.push_back(line.substr(kPrompt.size()));
  }
  return words;
}

/// Runs them in a folder of their own that holds a copy of the shipped problems.
void expect_commands_work(const std::string& file) {
  const TemporaryFolder folder;
  std::filesystem::copy(std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems",
                        folder.path() / "problems", std::filesystem::copy_options::recursive);
  const std::vector<std::string> words = commands(file);
  EXPECT_GE(words.size(), 6U);
  for (const std::string& command : words) {
    const CommandResult result = run_maxwrench(command, folder.path());
    EXPECT_EQ(result.exit_status, 0) << command << "\n" << result.err;
    EXPECT_FALSE(result.out.empty() && command.find("--out") == std::string::npos) << command;
  }
}

TEST(Readme, EveryCommandWorks) { expect_commands_work("README.md"); }

TEST(OwnRobotGuide, EveryCommandWorks) { expect_commands_work("docs/own_robot.md"); }

/// The files that the guide shows are those of the rover, up to comments and what it leaves out.
TEST(OwnRobotGuide, ShowsTheShippedFiles) {
  const std::filesystem::path root(MAXWRENCH_SOURCE_DIR);
  std::istringstream guide(read_text(root / "docs/own_robot.md"));
  const std::string files = read_text(root / "problems/mobile/rover.toml") +
                            read_text(root / "problems/mobile/push.toml");
  bool inside = false;
  int lines = 0;
  for (std::string line; std::getline(guide, line);) {
    if (line.starts_with("```")) {
      inside = line == "```toml";
      continue;
    }
    if (!inside || line.empty() || line.starts_with("#")) continue;
    ++lines;
    EXPECT_NE(files.find(line), std::string::npos) << line;
  }
  EXPECT_GT(lines, 25);
}

}  // namespace
}  // namespace maxwrench
