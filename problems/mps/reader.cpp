#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "maxwrench/mps.h"
#include "problems/mps/fields.h"

namespace maxwrench {
namespace {

struct MpsRow {
  std::string name;
  char type;             ///< N (the objective), E, L, G, or '-' for an ignored row
  int last_column = -1;  ///< the last column that has an entry in this row
  std::optional<double> rhs = {}, range = {};
};

struct MpsColumn {
  std::string name;
  double cost = 0, l = 0, u = kInfinity;
  bool has_lower = false, has_upper = false;  ///< whether a card sets the bound
};

constexpr double kLargestBound = 1e25;  // a larger bound in a file means none

class Cards {
 public:
  explicit Cards(const std::string& path) : path_(path) { read(); }
  MpsProgram program() const;

 private:
  /// A column or set ("" if a set has no name), and its value in one or two rows.
  struct NamedPairs {
    std::string name;
    std::vector<std::pair<int, double>> pairs;
  };

  [[noreturn]] void fail(const std::string& expected) const;
  void read();
  void begin_section(const MpsFields& fields);
  void read_card(const std::string& line);
  void read_sense(const std::string& word);
  void read_row(const MpsFields& fields);
  std::optional<NamedPairs> as_pairs(const MpsFields& fields) const;
  NamedPairs read_pairs(const std::string& line, bool may_lack_name) const;
  void read_column(const std::string& line);
  void read_set(const std::string& line);
  void read_bound(const std::string& line);
  bool try_bound(MpsFields fields);
  bool of_first_set(const std::string& set);

  std::string path_, section_, name_, set_name_;
  int number_ = 0;
  bool minimize_ = true, ended_ = false, set_started_ = false, has_objective_ = false;
  std::set<std::string> seen_;
  std::vector<MpsRow> rows_;
  std::vector<MpsColumn> columns_;
  std::map<std::string, int> row_of_, column_of_;
  std::vector<Eigen::Triplet<double>> entries_;
};

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
    const MpsFields fields = mps_words(line);
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

void Cards::begin_section(const MpsFields& fields) {
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
  if (title == "NAME" && fields.size() > 1) name_ = fields[1];
  if (title == "OBJSENSE" && fields.size() > 1) read_sense(fields[1]);
  if (title == "COLUMNS" && !seen_.count("ROWS")) fail("ROWS before COLUMNS");
  if ((title == "RHS" || title == "RANGES" || title == "BOUNDS") && !seen_.count("COLUMNS")) {
    fail("COLUMNS first");
  }
  ended_ = title == "ENDATA";
}

void Cards::read_card(const std::string& line) {
  if (section_ == "OBJSENSE") return read_sense(mps_words(line)[0]);
  if (section_ == "ROWS") return read_row(mps_words(line));
  if (section_ == "COLUMNS") return read_column(line);
  if (section_ == "RHS" || section_ == "RANGES") return read_set(line);
  if (section_ == "BOUNDS") return read_bound(line);
  fail("a section title");
}

void Cards::read_sense(const std::string& word) {
  std::string upper;
  for (const char c : word) upper += static_cast<char>(std::toupper(c));
  if (upper == "MAX" || upper == "MAXIMIZE" || upper == "MAXIMISE") {
    minimize_ = false;
  } else if (upper == "MIN" || upper == "MINIMIZE" || upper == "MINIMISE") {
    minimize_ = true;
  } else {
    fail("MIN or MAX");
  }
}

void Cards::read_row(const MpsFields& fields) {
  if (fields.size() < 2 || fields[0].size() != 1 ||
      std::string("NELG").find(fields[0]) == std::string::npos) {
    fail("a type N, E, L or G and a name");
  }
  MpsRow row{.name = mps_name(fields, 1), .type = fields[0][0]};
  const int place = static_cast<int>(rows_.size());
  if (!row_of_.emplace(row.name, place).second) fail("row " + row.name + " only once");
  if (row.type == 'N') {
    if (has_objective_) row.type = '-';
    has_objective_ = true;
  }
  rows_.push_back(row);
}

/// Reads the fields [name, row, value] or [name, row, value, row, value].
std::optional<Cards::NamedPairs> Cards::as_pairs(const MpsFields& fields) const {
  if (fields.size() != 3 && fields.size() != 5) return std::nullopt;
  NamedPairs result{fields[0], {}};
  for (std::size_t k = 1; k < fields.size(); k += 2) {
    const auto row = row_of_.find(fields[k]);
    const std::optional<double> value = mps_number(fields[k + 1]);
    if (row == row_of_.end() || !value) return std::nullopt;
    result.pairs.emplace_back(row->second, *value);
  }
  return result;
}

Cards::NamedPairs Cards::read_pairs(const std::string& line, bool may_lack_name) const {
  MpsFields fields = mps_words(line);
  if (const auto found = as_pairs(fields)) return *found;
  if (may_lack_name) {
    fields.insert(fields.begin(), "");
    if (const auto found = as_pairs(fields)) return *found;
  }
  fields = mps_columns(line);
  if (!fields.empty()) fields.erase(fields.begin());
  const auto found = as_pairs(fields);
  if (found && (may_lack_name || !found->name.empty())) return *found;
  fail("a name and one or two pairs of a known row and a number");
}

void Cards::read_column(const std::string& line) {
  if (line.find("'MARKER'") != std::string::npos) {
    if (line.find("'SOS") != std::string::npos) fail("no SOS marker");
    return;  // integer markers are ignored: the relaxation is read
  }
  const auto [name, pairs] = read_pairs(line, false);
  if (columns_.empty() || columns_.back().name != name) {
    const bool is_new = column_of_.emplace(name, static_cast<int>(columns_.size())).second;
    if (!is_new) fail("the cards of column " + name + " together");
    columns_.push_back({.name = name});
  }
  const int column = static_cast<int>(columns_.size()) - 1;
  for (const auto& [place, value] : pairs) {
    MpsRow& row = rows_[static_cast<std::size_t>(place)];
    if (row.type == '-') continue;
    if (row.last_column == column) fail("row " + row.name + " once in column " + name);
    row.last_column = column;
    if (row.type == 'N') columns_.back().cost = value;
    if (row.type != 'N' && value != 0) entries_.emplace_back(place, column, value);
  }
}

bool Cards::of_first_set(const std::string& set) {
  if (!set_started_) set_name_ = set;
  set_started_ = true;
  return set == set_name_;
}

void Cards::read_set(const std::string& line) {
  const auto [set, pairs] = read_pairs(line, true);
  if (!of_first_set(set)) return;
  const bool ranges = section_ == "RANGES";
  for (const auto& [place, value] : pairs) {
    MpsRow& row = rows_[static_cast<std::size_t>(place)];
    if (row.type == '-' || (ranges && row.type == 'N')) continue;
    std::optional<double>& number = ranges ? row.range : row.rhs;
    if (number) fail("row " + row.name + " only once");
    number = value;
  }
}

void Cards::read_bound(const std::string& line) {
  if (try_bound(mps_words(line)) || try_bound(mps_columns(line))) return;
  fail(
      "a type UP, LO, FX, FR, MI, PL, BV, LI or UI, a known column and, if it needs one, a number");
}

bool Cards::try_bound(MpsFields f) {
  static const std::set<std::string> kWithValue{"UP", "LO", "FX", "UI", "LI"};
  static const std::set<std::string> kWithout{"FR", "MI", "PL", "BV"};
  if (f.empty()) return false;
  const std::string type = f[0];
  const bool with_value = kWithValue.count(type) > 0;
  if (!with_value && !kWithout.count(type)) return false;
  const std::size_t size = with_value ? 4 : 3;
  const bool named = f.size() >= size && column_of_.count(f[2]);
  if (!named) {
    if (f.size() < 2 || !column_of_.count(f[1])) return false;
    f.insert(f.begin() + 1, "");
  }
  if (f.size() < size || f.size() > 4) return false;
  const std::optional<double> value = with_value ? mps_number(f[3]) : 0;
  if (!value) return false;
  if (!of_first_set(f[1])) return true;
  MpsColumn& column = columns_[static_cast<std::size_t>(column_of_.at(f[2]))];
  const bool upper = type == "UP" || type == "UI" || type == "PL";
  const bool lower = type == "LO" || type == "LI" || type == "MI";
  if ((!upper && column.has_lower) || (!lower && column.has_upper)) {
    fail("one lower and one upper bound of column " + column.name);
  }
  const bool alone = !column.has_lower;
  column.has_lower = column.has_lower || !upper;
  column.has_upper = column.has_upper || !lower;
  if (type == "FR" || type == "MI") column.l = -kInfinity;
  if (type == "BV") column.u = 1;
  if (!with_value) return true;
  if (!lower) column.u = upper && *value > kLargestBound ? kInfinity : *value;
  if (!upper) column.l = lower && *value < -kLargestBound ? -kInfinity : *value;
  if (upper && alone && *value < 0) column.l = -kInfinity;
  return true;
}

/// The least and the largest value of a row.
std::pair<double, double> range_of(const MpsRow& row) {
  const double rhs = row.rhs.value_or(0), range = row.range.value_or(0);
  if (row.type == 'E') return {rhs + std::min(range, 0.0), rhs + std::max(range, 0.0)};
  const double width = row.range ? std::abs(range) : kInfinity;
  return row.type == 'L' ? std::pair(rhs - width, rhs) : std::pair(rhs, rhs + width);
}

MpsProgram Cards::program() const {
  MpsProgram result;
  result.name = name_;
  result.minimize = minimize_;
  result.file_cols = static_cast<int>(columns_.size());
  LinearProgram& p = result.program;
  std::vector<MpsColumn> columns = columns_;
  std::vector<int> places(rows_.size());
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> b;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const MpsRow& row = rows_[i];
    places[i] = static_cast<int>(b.size());
    if (row.type == 'N') {
      result.objective_name = row.name;
      result.constant = 0 - row.rhs.value_or(0);
    }
    if (row.type == 'N' || row.type == '-') continue;
    p.row_names.push_back(row.name);
    const auto [low, high] = range_of(row);
    b.push_back(low == high ? low : 0);
    if (low == high) continue;
    entries.emplace_back(places[i], static_cast<int>(columns.size()), -1.0);
    columns.push_back({.name = row.name, .l = low, .u = high});
  }
  for (const auto& entry : entries_) {
    entries.emplace_back(places[static_cast<std::size_t>(entry.row())], entry.col(), entry.value());
  }
  const auto cols = static_cast<Eigen::Index>(columns.size());
  p.b = Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size()));
  p.A.resize(p.b.size(), cols);
  p.A.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::VectorXd* v : {&p.c, &p.l, &p.u}) v->resize(cols);
  for (Eigen::Index j = 0; j < cols; ++j) {
    const MpsColumn& column = columns[static_cast<std::size_t>(j)];
    p.c[j] = (minimize_ ? -1 : 1) * column.cost;
    p.l[j] = column.l;
    p.u[j] = column.u;
    p.col_names.push_back(column.name);
  }
  return result;
}

}  // namespace

MpsProgram read_mps(const std::string& path) { return Cards(path).program(); }

}  // namespace maxwrench
