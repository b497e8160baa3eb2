#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/house/documents.h"

// The commands of the documents run and print what is shown; the guides show the shipped files.

namespace maxwrench {
namespace {

/// The lines shown behind a command are lines of its output, in this order.
void expect_shown(const std::string& command, const std::string& output,
                  const std::vector<std::string>& shown) {
  std::istringstream text(output);
  for (const std::string& expected : shown) {
    bool found = false;
    for (std::string line; !found && std::getline(text, line);) found = is_shown(line, expected);
    EXPECT_TRUE(found) << command << "\nis said to print\n"
                       << expected << "\nbut prints\n"
                       << output;
    if (!found) return;
  }
}

/// Runs the commands of a console block and compares what it shows of their output.
void run_block(const DocumentBlock& block, const fs::path& folder) {
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    if (!block.lines[i].starts_with(kPrompt)) continue;
    const std::string command = block.lines[i].substr(kPrompt.size());
    std::vector<std::string> shown;
    while (i + 1 < block.lines.size() && !block.lines[i + 1].starts_with("$ ")) {
      shown.push_back(block.lines[++i]);
    }
    const CommandResult result = run_maxwrench(command, folder);
    EXPECT_EQ(result.exit_status, 0) << command << "\n" << result.err;
    EXPECT_FALSE(result.out.empty() && command.find("--out") == std::string::npos) << command;
    expect_shown(command, result.out, shown);
  }
}

class Docs : public testing::TestWithParam<std::string> {};

/// In a folder with copies of the shipped problems and trajectories and the files of the document:
/// TOML blocks that begin with their path as a comment.
TEST_P(Docs, EveryCommandWorks) {
  const TemporaryFolder folder;
  fs::copy(kRoot / "problems", folder.path() / "problems", fs::copy_options::recursive);
  fs::create_directories(folder.path() / "tests/data");
  fs::copy(kRoot / "tests/data/robots", folder.path() / "tests/data/robots",
           fs::copy_options::recursive);
  fs::create_directory(folder.path() / "benchmarks");
  fs::copy(kRoot / "benchmarks/suites", folder.path() / "benchmarks/suites");
  fs::create_directory(folder.path() / "examples");
  fs::copy(kRoot / "examples/tasks", folder.path() / "examples/tasks", fs::copy_options::recursive);
  fs::copy(kRoot / "examples/motions", folder.path() / "examples/motions");
  fs::create_directory(folder.path() / "results");
  fs::copy(kRoot / "results/trajectories", folder.path() / "results/trajectories");
  static const std::regex kPath("# ([a-z_/]+\\.toml)");
  for (const DocumentBlock& block : document_blocks(GetParam())) {
    if (block.kind == "console") run_block(block, folder.path());
    std::smatch path;
    if (block.kind != "toml" || block.lines.empty()) continue;
    if (!std::regex_match(block.lines.front(), path, kPath)) continue;
    const fs::path file = folder.path() / path[1].str();
    fs::create_directories(file.parent_path());
    std::ofstream out(file);
    for (const std::string& line : block.lines) out << line << '\n';
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& of) {
  std::string name = of.param;
  const auto odd = [](unsigned char c) { return std::isalnum(c) == 0; };
  std::replace_if(name.begin(), name.end(), odd, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, Docs, testing::ValuesIn(documents_with_commands()), test_name);

/// The files that the guide shows are those of the rover, up to comments and what it leaves out; or
/// they name their own path.
TEST(OwnRobotGuide, ShowsTheShippedFiles) {
  const std::string files = read_text(kRoot / "problems/mobile/rover.toml") +
                            read_text(kRoot / "problems/mobile/push.toml");
  int lines = 0;
  for (const DocumentBlock& block : document_blocks("docs/robot_files.md")) {
    if (block.kind != "toml" || block.lines.front().starts_with("# problems/")) continue;
    for (const std::string& line : block.lines) {
      if (line.empty() || line.starts_with("#")) continue;
      ++lines;
      EXPECT_NE(files.find(line), std::string::npos) << line;
    }
  }
  EXPECT_GT(lines, 25);
}

}  // namespace
}  // namespace maxwrench
