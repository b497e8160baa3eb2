#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/support.h"

// What the documents say is tried: their commands run and print what is shown, their links lead
// somewhere, their numbers are those of the results.

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot(MAXWRENCH_SOURCE_DIR);

/// README.md and the pages of docs/, by their paths from the root.
std::vector<std::string> documents() {
  std::vector<std::string> files = {"README.md"};
  for (const auto& entry : fs::directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(fs::relative(entry.path(), kRoot));
  }
  std::sort(files.begin() + 1, files.end());
  return files;
}

/// What stands between two fences of a document.
struct DocumentBlock {
  std::string kind;  ///< such as console
  std::vector<std::string> lines;
};

std::vector<DocumentBlock> document_blocks(const std::string& file) {
  std::vector<DocumentBlock> found;
  bool inside = false;
  std::istringstream text(read_text(kRoot / file));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), {}});
    } else if (inside) {
      found.back().lines.push_back(line);
    }
  }
  EXPECT_FALSE(inside) << file << ": a block without an end";
  return found;
}

const std::string kPrompt = "$ build/maxwrench ";

std::vector<std::string> documents_with_commands() {
  std::vector<std::string> files;
  for (const std::string& file : documents()) {
    if (read_text(kRoot / file).find("\n" + kPrompt) != std::string::npos) files.push_back(file);
  }
  return files;
}

/// Whether a line is the one shown, whose end may be left out: "beta ...".
bool is_shown(const std::string& line, const std::string& shown) {
  if (!shown.ends_with("...")) return line == shown;
  return line.starts_with(shown.substr(0, shown.size() - 3));
}

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

/// In a folder with copies of the shipped problems and plans and the files of the document: TOML
/// blocks that begin with their path as a comment.
TEST_P(Docs, EveryCommandWorks) {
  const TemporaryFolder folder;
  fs::copy(kRoot / "problems", folder.path() / "problems", fs::copy_options::recursive);
  fs::create_directory(folder.path() / "benchmarks");
  fs::copy(kRoot / "benchmarks/plans", folder.path() / "benchmarks/plans");
  fs::create_directory(folder.path() / "results");
  fs::copy(kRoot / "results/plans", folder.path() / "results/plans");
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

TEST(Readme, IsShort) {
  const std::string text = read_text(kRoot / "README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 200);
  EXPECT_GE(documents_with_commands().size(), 5U);
}

std::vector<std::string> result_lines() {
  std::vector<std::string> lines;
  for (const auto& entry : fs::directory_iterator(kRoot / "results")) {
    if (entry.path().extension() != ".txt") continue;
    std::istringstream text(read_text(entry.path()));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
  }
  return lines;
}

/// Numbers with a decimal point, without their signs.
std::vector<std::string> decimals(const std::string& text) {
  static const std::regex kNumber("[0-9]+\\.[0-9]+");
  return {std::sregex_token_iterator(text.begin(), text.end(), kNumber), {}};
}

TEST(Readme, NumbersAreThoseOfTheResults) {
  const std::vector<std::string> results = result_lines();
  for (const DocumentBlock& block : document_blocks("README.md")) {
    if (block.kind != "text") continue;
    for (const std::string& shown : block.lines) {
      EXPECT_TRUE(std::any_of(results.begin(), results.end(), [&](const std::string& line) {
        return is_shown(line, shown);
      })) << shown;
    }
  }
  std::set<std::string> known;
  for (const std::string& line : results) {
    for (const std::string& number : decimals(line)) known.insert(number);
  }
  int numbers = 0;
  std::istringstream readme(read_text(kRoot / "README.md"));
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("|")) continue;
    for (const std::string& number : decimals(line)) {
      ++numbers;
      EXPECT_TRUE(known.contains(number)) << number << " in " << line;
    }
  }
  EXPECT_GT(numbers, 40);
}

/// As GitHub makes them of headings: lower case, hyphens for blanks, letters and digits only.
std::set<std::string> anchors(const fs::path& file) {
  std::set<std::string> found;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("#")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# "))) {
      if (c == ' ') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    found.insert(anchor);
  }
  return found;
}

TEST(DocsLinks, LeadSomewhere) {
  static const std::regex kLink("\\]\\(([^)# ]*)(#[^) ]*)?\\)");
  std::vector<std::string> files = documents();
  files.emplace_back("CONTRIBUTING.md");
  for (const auto& entry : fs::directory_iterator(kRoot / "problems")) {
    if (fs::exists(entry.path() / "README.md"))
      files.push_back(fs::relative(entry.path() / "README.md", kRoot));
  }
  int links = 0;
  for (const std::string& file : files) {
    const std::string text = read_text(kRoot / file);
    for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
      const std::string path = (*link)[1];
      if (path.find("://") != std::string::npos) continue;
      ++links;
      const fs::path target = path.empty() ? kRoot / file : (kRoot / file).parent_path() / path;
      EXPECT_TRUE(fs::exists(target)) << file << ": " << path;
      if (!fs::exists(target)) continue;
      const std::string anchor = (*link)[2];
      if (anchor.empty()) continue;
      EXPECT_TRUE(anchors(target).contains(anchor.substr(1))) << file << ": " << path << anchor;
    }
  }
  EXPECT_GT(links, 30);
}

/// Files that are named by their path from the root; what is in capitals stands for a name.
TEST(DocsPaths, Exist) {
  static const std::regex kFile(
      "`((include|lib|solvers|problems|drawing|benchmarks|cli|examples|tests|results|docs|paper)/"
      "[a-z0-9_/.]*)`");
  std::vector<std::string> files = documents();
  files.emplace_back("CONTRIBUTING.md");
  int paths = 0;
  for (const std::string& file : files) {
    const std::string text = read_text(kRoot / file);
    for (std::sregex_iterator path(text.begin(), text.end(), kFile), end; path != end; ++path) {
      ++paths;
      EXPECT_TRUE(fs::exists(kRoot / (*path)[1].str())) << file << ": " << (*path)[1];
    }
  }
  EXPECT_GT(paths, 40);
}

/// The files that the guide shows are those of the rover, up to comments and what it leaves out; or
/// they name their own path.
TEST(OwnRobotGuide, ShowsTheShippedFiles) {
  const std::string files = read_text(kRoot / "problems/mobile/rover.toml") +
                            read_text(kRoot / "problems/mobile/push.toml");
  int lines = 0;
  for (const DocumentBlock& block : document_blocks("docs/own_robot.md")) {
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
