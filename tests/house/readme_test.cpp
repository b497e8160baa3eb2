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

/// README.md and the pages of docs/ and its folders, by their paths from the root.
std::vector<std::string> documents() {
  std::vector<std::string> files = {"README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
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

std::vector<std::string> split(const std::string& line, const std::regex& by) {
  return {std::sregex_token_iterator(line.begin(), line.end(), by, -1), {}};
}

/// The cells of a row of a table, without blanks around them.
std::vector<std::string> cells_of(const std::string& row) {
  static const std::regex kBar(" *\\| *");
  std::vector<std::string> cells = split(row, kBar);
  cells.erase(cells.begin());
  return cells;
}

/// The words of the first line that begins with `line` behind the line that begins with `section`.
std::vector<std::string> words_of(const std::string& file, const std::string& section,
                                  const std::string& line) {
  static const std::regex kBlanks(" +");
  std::istringstream text(read_text(kRoot / "results" / file));
  bool inside = section.empty();
  for (std::string at; std::getline(text, at);) {
    inside = inside || at.starts_with(section);
    if (inside && at.starts_with(line)) {
      return split(std::regex_replace(at.substr(line.size()), std::regex("^ +"), ""), kBlanks);
    }
  }
  ADD_FAILURE() << file << ": no line '" << line << "' behind '" << section << "'";
  return {};
}

/// Where the numbers of a row come from: columns 1 to 6 of the README's table are words of a line.
struct PaperRow {
  std::string row;
  std::string file, section, line;
  std::vector<int> words;  ///< by column; -1: nothing is shown
};

const PaperRow kPaperRows[] = {
    {"torque about the vertical, N m: default posture",
     "uvms_static.txt",
     "uvms/valve",
     "default",
     {2, 0, 4, 3, 1}},
    {"torque: best posture by beta_1", "uvms_static.txt", "uvms/valve", "beta_1", {4, 2, 6, 5, 3}},
    {"torque: best posture by beta_2", "uvms_static.txt", "uvms/valve", "beta_2", {4, 2, 6, 5, 3}},
    {"torque: best posture by beta_3 (other components free)",
     "uvms_static.txt",
     "uvms/valve",
     "beta_3",
     {4, 0, 6, 5, 3}},
    {"lift, kg: default posture", "uvms_static.txt", "uvms/lift", "default", {2, 0, 4, 3, 1}},
    {"lift: best posture by beta_1", "uvms_static.txt", "uvms/lift", "beta_1", {4, 2, 6, 5, 3}},
    {"lift: best posture by beta_2", "uvms_static.txt", "uvms/lift", "beta_2", {4, 2, 6, 5, 3}},
    {"torque throughout a turn by 180° in 5 s, N m: fixed posture",
     "uvms_motion.txt",
     "uvms/valve_trajectory",
     "spline    fixed",
     {6, 0, 9, 7, 3, 5}},
    {"turn: best trajectory",
     "uvms_motion.txt",
     "uvms/valve_trajectory",
     "spline    optimised",
     {6, 0, 9, 7, 3, 5}},
    {"peak torque in an impulse of 2.5 s, N m: static",
     "uvms_motion.txt",
     "uvms/valve_impulse",
     "spline    static",
     {6, 0, 9, 7, 3, 5}},
    {"impulse: best trajectory",
     "uvms_motion.txt",
     "uvms/valve_impulse",
     "spline    impulse",
     {6, 0, 9, 7, 3, 5}},
    {"torque with a rigid bar, N m: one contact", "dual.txt", "", "one contact", {1, 0}},
    {"rigid bar: the arm pushes on a wall at the default place",
     "dual.txt",
     "",
     "default contact",
     {1, 0, 4, 2}},
    {"rigid bar: the arm pushes at the best place", "dual.txt", "", "best contact", {2, 0, 5, 3}},
    {"fitted: planar vehicle, largest force, N: beta_1", "planar.txt", "", "beta_1", {0, 1}},
    {"fitted: planar beta_2", "planar.txt", "", "beta_2", {0, 1}},
    {"fitted: planar beta_3", "planar.txt", "", "beta_3", {0, 1}},
};

/// "+13.0 %" is two words of a line.
std::string without_unit(const std::string& cell) { return cell.substr(0, cell.find(' ')); }

/// Every cell with a number, by the line and the word that it comes from.
TEST(Readme, PaperTableIsThatOfTheResults) {
  std::istringstream readme(read_text(kRoot / "README.md"));
  std::size_t rows = 0;
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("| ") || line.starts_with("| |") || line.starts_with("| `") ||
        line.starts_with("| **") || line.starts_with("| search")) {
      continue;
    }
    SCOPED_TRACE(line);
    const std::vector<std::string> cells = cells_of(line);
    const auto* source = std::find_if(std::begin(kPaperRows), std::end(kPaperRows),
                                      [&](const PaperRow& row) { return row.row == cells[0]; });
    ASSERT_NE(source, std::end(kPaperRows)) << "a row without a source";
    ++rows;
    const std::vector<std::string> words = words_of(source->file, source->section, source->line);
    for (std::size_t column = 1; column < cells.size(); ++column) {
      if (column > source->words.size()) {
        EXPECT_TRUE(cells[column].empty() || cells[column] == "yes") << cells[column];
        continue;
      }
      const auto word = static_cast<std::size_t>(source->words[column - 1]);
      ASSERT_LT(word, words.size());
      EXPECT_EQ(without_unit(cells[column]), words[word]) << "column " << column;
    }
  }
  EXPECT_EQ(rows, std::size(kPaperRows));
}

/// What `plot uvms/valve --best` draws, a command of the README, as `reproduce` wrote it: with the
/// value of the paper's second measure, and small enough for a page.
TEST(Readme, ItsFirstPictureShowsTheOptimum) {
  const std::string readme = read_text(kRoot / "README.md");
  std::smatch picture;
  ASSERT_TRUE(std::regex_search(readme, picture, std::regex("!\\[[^\\]]*\\]\\(([^)]*)\\)")));
  EXPECT_EQ(picture[1], "results/uvms_valve_best.svg");
  const std::string svg = read_text(kRoot / picture[1].str());
  EXPECT_LT(svg.size(), 300'000U);
  const std::string best = words_of("uvms_static.txt", "uvms/valve", "beta_2")[0];
  EXPECT_NE(svg.find(">\u03b2 = " + best + " N m, "), std::string::npos) << best;
  EXPECT_NE(svg.find(">\u03b2 = 9.000 N m, "), std::string::npos);
}

/// Blocks of text and the table of searches are lines of the results.
TEST(Readme, LinesAreThoseOfTheResults) {
  const std::vector<std::string> results = result_lines();
  const auto expect_known = [&](const std::string& shown) {
    EXPECT_TRUE(std::any_of(results.begin(), results.end(), [&](const std::string& line) {
      return is_shown(line, shown);
    })) << shown;
  };
  for (const DocumentBlock& block : document_blocks("README.md")) {
    if (block.kind == "text") std::for_each(block.lines.begin(), block.lines.end(), expect_known);
  }
  int searches = 0;
  std::istringstream readme(read_text(kRoot / "README.md"));
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("| `") && !line.starts_with("| **")) continue;
    ++searches;
    expect_known(line);
  }
  EXPECT_GT(searches, 5);
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
      "`((include|lib|solvers|problems|drawing|benchmarks|view|cli|examples|tests|results|docs|"
      "paper)/"
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
