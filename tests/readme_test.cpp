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

TEST(Readme, EveryCommandWorks) {
  const TemporaryFolder folder;
  std::filesystem::create_directory_symlink(
      std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "problems", folder.path() / "problems");
  const std::vector<std::string> words = commands("README.md");
  EXPECT_GE(words.size(), 6U);
  for (const std::string& command : words) {
    const CommandResult result = run_maxwrench(command, folder.path());
    EXPECT_EQ(result.exit_status, 0) << command << "\n" << result.err;
    EXPECT_FALSE(result.out.empty() && command.find("--out") == std::string::npos) << command;
  }
}

}  // namespace
}  // namespace maxwrench
