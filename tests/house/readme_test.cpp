#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/house/documents.h"

// The README is short, and its numbers are those of the results.

namespace maxwrench {
namespace {

TEST(Readme, IsShort) {
  const std::string text = read_text(kRoot / "README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 225);
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

}  // namespace
}  // namespace maxwrench
