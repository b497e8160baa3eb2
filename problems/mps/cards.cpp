#include "problems/mps/cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace maxwrench::mps {
namespace {

/// Fortran writes 1.5D+3.
std::string with_c_exponent(std::string number) {
  std::replace_if(
      number.begin(), number.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  return number;
}

bool is_number(const std::string& text) {
  if (text.empty() || text.find_first_of("xXnN") != std::string::npos) return false;
  const std::string number = with_c_exponent(text);
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  return *end == '\0' && std::isfinite(value);
}

bool all_numbers(const Fields& fields, std::size_t first) {
  for (std::size_t k = first; k < fields.size(); k += 2) {
    if (!is_number(fields[k])) return false;
  }
  return true;
}

Fields split(const std::string& line) {
  std::istringstream stream(line);
  Fields fields;
  for (std::string field; stream >> field;) fields.push_back(field);
  return fields;
}

/// One name of several words: the format allows blanks, CoinMpsIO would drop them.
std::string join(const Fields& words, std::size_t first = 0) {
  std::string name;
  for (std::size_t k = first; k < words.size(); ++k) {
    if (k > first) name += '_';
    name += words[k];
  }
  return name;
}

/// The fixed columns 2-3, 5-12, 15-22, 25-36, 40-47, 50-61.
Fields split_fixed(const std::string& line) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kColumns{
      {{1, 2}, {4, 8}, {14, 8}, {24, 12}, {39, 8}, {49, 12}}};
  Fields fields;
  for (const auto& [begin, length] : kColumns) {
    fields.push_back(begin < line.size() ? join(split(line.substr(begin, length))) : "");
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

}  // namespace

void Cards::fail(const std::string& expected) const {
  throw std::invalid_argument(fmt::format("{}, line {}: expected {} in section {}", path_, number_,
                                          expected, section_.empty() ? "NAME" : section_));
}

void Cards::read() {
  std::ifstream file(path_);
  if (!file || std::filesystem::is_directory(path_)) {
    throw std::invalid_argument(path_ + ": expected a readable MPS file");
  }
  std::string line;
  while (!ended_ && std::getline(file, line)) {
    ++number_;
    for (char& c : line) c = c == '\t' || c == '\r' ? ' ' : c;
    if (line.find('\0') != std::string::npos) fail("text");
    const Fields fields = split(line);
    if (fields.empty() || line[0] == '*') continue;
    for (const std::string& field : fields) {
      if (field.size() > 100) fail("fields of at most 100 characters");
    }
    if (line[0] != ' ') {
      begin_section(fields);
    } else {
      read_card(line);
    }
  }
  if (!ended_) fail("ENDATA at the end of the file");
  if (!seen_.count("ROWS") || !seen_.count("COLUMNS")) fail("ROWS and COLUMNS before ENDATA");
}

void Cards::begin_section(const Fields& fields) {
  static const std::set<std::string> kSections{"NAME",   "ROWS",   "COLUMNS",  "RHS",
                                               "RANGES", "BOUNDS", "OBJSENSE", "ENDATA"};
  const std::string& title = fields[0];
  if (!kSections.count(title)) {
    fail(
        "NAME, OBJSENSE, ROWS, COLUMNS, RHS, RANGES, BOUNDS or ENDATA (no integer, quadratic or "
        "SOS sections) instead of " +
        title);
  }
  if (!seen_.insert(title).second) fail("section " + title + " only once");
  section_ = title;
  set_started_ = false;
  if (title == "NAME" && fields.size() > 1) name = fields[1];
  if (title == "OBJSENSE" && fields.size() > 1) read_sense(fields[1]);
  if (title == "COLUMNS" && !seen_.count("ROWS")) fail("ROWS before COLUMNS");
  if ((title == "RHS" || title == "RANGES" || title == "BOUNDS") && !seen_.count("COLUMNS")) {
    fail("COLUMNS first");
  }
  ended_ = title == "ENDATA";
}

void Cards::read_card(const std::string& line) {
  if (section_ == "OBJSENSE") return read_sense(split(line)[0]);
  if (section_ == "ROWS") return read_row(split(line));
  if (section_ == "COLUMNS") return read_column(line);
  if (section_ == "RHS" || section_ == "RANGES") return read_set(line);
  if (section_ == "BOUNDS") return read_bound(line);
  fail("a section title");
}

void Cards::read_sense(const std::string& word) {
  std::string upper;
  for (const char c : word) upper += static_cast<char>(std::toupper(c));
  if (upper == "MAX" || upper == "MAXIMIZE" || upper == "MAXIMISE") {
    minimize = false;
  } else if (upper == "MIN" || upper == "MINIMIZE" || upper == "MINIMISE") {
    minimize = true;
  } else {
    fail("MIN or MAX");
  }
}

void Cards::read_row(const Fields& fields) {
  if (fields.size() < 2 || fields[0].size() != 1 ||
      std::string("NELG").find(fields[0]) == std::string::npos) {
    fail("a type N, E, L or G and a name");
  }
  const std::string row = join(fields, 1);
  if (!rows_.insert(row).second) fail("row " + row + " only once");
  if (fields[0] == "N") {
    if (!objective_.empty()) {
      free_rows_.insert(row);
      return;
    }
    objective_ = row;
  }
  rows_text_ += fmt::format(" {} {}\n", fields[0], row);
}

/// [name, row, value, row, value] of a card; the name is "" where a set has none.
Fields Cards::pairs(const std::string& line, bool may_lack_name) const {
  const auto fits = [&](const Fields& f) {
    if ((f.size() != 3 && f.size() != 5) || !all_numbers(f, 2)) return false;
    return rows_.count(f[1]) > 0 && (f.size() == 3 || rows_.count(f[3]) > 0);
  };
  Fields fields = split(line);
  if (fits(fields)) return fields;
  if (may_lack_name) {
    fields.insert(fields.begin(), "");
    if (fits(fields)) return fields;
  }
  fields = split_fixed(line);
  if (!fields.empty()) fields.erase(fields.begin());
  if (fits(fields) && (may_lack_name || !fields[0].empty())) return fields;
  fail("a name and one or two pairs of a known row and a number");
}

void Cards::read_column(const std::string& line) {
  if (line.find("'MARKER'") != std::string::npos) {
    if (line.find("'SOS") != std::string::npos) fail("no SOS marker");
    return;  // the relaxation is read
  }
  const Fields fields = pairs(line, false);
  const bool known = !columns_.insert(fields[0]).second;
  if (known && fields[0] != column_) fail("the cards of column " + fields[0] + " together");
  column_ = fields[0];
  for (std::size_t k = 1; k < fields.size(); k += 2) {
    // A column without entries still exists.
    const bool dropped = free_rows_.count(fields[k]) > 0;
    columns_text_ += fmt::format(" {} {} {}\n", fields[0], dropped ? objective_ : fields[k],
                                 dropped ? "0" : with_c_exponent(fields[k + 1]));
  }
}

void Cards::read_set(const std::string& line) {
  const Fields fields = pairs(line, true);
  if (!set_started_) set_name_ = fields[0];
  set_started_ = true;
  if (fields[0] != set_name_) return;
  for (std::size_t k = 1; k < fields.size(); k += 2) {
    if (free_rows_.count(fields[k])) continue;
    if (section_ == "RANGES" && fields[k] == objective_) continue;
    (section_ == "RHS" ? rhs_text_ : ranges_text_) +=
        fmt::format(" SET {} {}\n", fields[k], with_c_exponent(fields[k + 1]));
  }
}

void Cards::read_bound(const std::string& line) {
  if (try_bound(split(line)) || try_bound(split_fixed(line))) return;
  fail(
      "a type UP, LO, FX, FR, MI, PL, BV, LI or UI, a known column and, if it needs one, a number");
}

bool Cards::try_bound(Fields f) {
  static const std::set<std::string> kWithValue{"UP", "LO", "FX", "UI", "LI"};
  static const std::set<std::string> kWithout{"FR", "MI", "PL", "BV"};
  if (f.empty()) return false;
  const std::string type = f[0] == "UI" ? "UP" : f[0] == "LI" ? "LO" : f[0];
  const bool with_value = kWithValue.count(type) > 0;
  if (!with_value && !kWithout.count(type)) return false;
  const std::size_t size = with_value ? 4 : 3;
  const bool named = f.size() >= size && columns_.count(f[2]);
  if (!named) {
    if (f.size() < 2 || !columns_.count(f[1])) return false;
    f.insert(f.begin() + 1, "");
  }
  if (f.size() < size || f.size() > 4 || (with_value && !is_number(f[3]))) return false;
  if (!set_started_) set_name_ = f[1];
  set_started_ = true;
  if (f[1] != set_name_) return true;
  if (type == "BV") {
    bounds_text_ += fmt::format(" LO SET {0} 0\n UP SET {0} 1\n", f[2]);
  } else {
    bounds_text_ +=
        fmt::format(" {} SET {} {}\n", type, f[2], with_value ? with_c_exponent(f[3]) : "");
  }
  return true;
}

std::string Cards::text() const {
  const std::string ranges = ranges_text_.empty() ? "" : "RANGES\n";
  const std::string bounds = bounds_text_.empty() ? "" : "BOUNDS\n";
  return fmt::format("NAME maxwrench FREE\nROWS\n{}COLUMNS\n{}RHS\n{}{}{}{}{}ENDATA\n", rows_text_,
                     columns_text_, rhs_text_, ranges, ranges_text_, bounds, bounds_text_);
}

}  // namespace maxwrench::mps
