#include "benchmarks/tables/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/write_file.h"

namespace maxwrench {
namespace {

/// Whether there is a file to read. A file that exists but cannot be read must not count as
/// missing, because writing would then lose its rows.
bool is_there(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) return false;
  if (!error && !std::filesystem::is_regular_file(status)) {
    error = std::make_error_code(std::errc::invalid_argument);
  }
  if (!error && !std::ifstream(file)) error = std::error_code(errno, std::generic_category());
  if (!error) return true;
  throw std::invalid_argument(file.string() + ": got '" + error.message() +
                              "', expected a table of maxwrench or no file");
}

}  // namespace

Table::Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns)
    : file_(std::move(file)),
      journal_file_(file_.string() + ".part"),
      columns_(std::move(columns)),
      key_columns_(key_columns) {
  read_all();
}

void Table::read_all() {
  lines_.clear();
  read(table_file(file_), true);
  left_over_ = read(journal_file_, false);
}

bool Table::read(const std::filesystem::path& file, bool whole) {
  if (!is_there(file)) return false;
  std::istringstream in(csv_text(file));
  std::string line;
  if (!std::getline(in, line)) return false;
  if (in.eof() && !whole) return false;  // torn
  const std::vector<std::string> before = split_csv(line);
  const std::vector<std::size_t> places = places_of(file, before);
  const bool same = before == columns_;
  std::vector<std::string> row(columns_.size());
  bool any = false;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> fields = split_csv(line);
    if (in.eof() || fields.size() != before.size()) {
      if (!whole) continue;
      throw std::invalid_argument(fmt::format(
          "{}: line {}: got {} fields{}, expected {} and a break", file.string(), number,
          fields.size(), in.eof() ? " without a line break" : "", before.size()));
    }
    for (std::size_t i = 0; i < places.size(); ++i) row[places[i]] = fields[i];
    lines_[order_of(row)] = same ? line : join_csv(row);
    any = true;
  }
  return any;
}

std::vector<std::size_t> Table::places_of(const std::filesystem::path& file,
                                          const std::vector<std::string>& before) const {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < std::max(before.size(), key_columns_); ++i) {
    const std::string& column = i < before.size() ? before[i] : "";
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    const auto place = static_cast<std::size_t>(found - columns_.begin());
    if (found == columns_.end() || (i < key_columns_ && place != i)) {
      throw std::invalid_argument(fmt::format(
          "{}: line 1: got column '{}', expected a table of this version, or another folder",
          file.string(), column));
    }
    places.push_back(place);
  }
  return places;
}

/// A text whose alphabetical order is that of the rows. Whole numbers are preceded by their length.
std::string Table::order_of(const std::vector<std::string>& row) const {
  std::string text;
  for (std::size_t i = 0; i < key_columns_; ++i) {
    const bool whole = row[i].find_first_not_of("0123456789") == std::string::npos;
    if (whole) text += static_cast<char>(1 + std::min<std::size_t>(row[i].size(), 30));
    text += one_line(row[i]) + '\0';
  }
  return text;
}

void Table::hold() {
  if (journal_) return;
  journal_ = std::make_unique<Journal>(journal_file_);
  if (!changed_) read_all();
}

void Table::put(const std::vector<std::string>& row) {
  hold();
  if (!begun_) {
    if (left_over_) write_rows();
    journal_->begin(join_csv(columns_));
    begun_ = true;
  }
  journal_->add(join_csv(row));
  add(row);
}

void Table::add(const std::vector<std::string>& row) {
  lines_[order_of(row)] = join_csv(row);
  changed_ = true;
}

void Table::drop(const std::function<bool(const std::vector<std::string>&)>& which) {
  const std::size_t dropped =
      std::erase_if(lines_, [&](const auto& entry) { return which(split_csv(entry.second)); });
  changed_ = changed_ || dropped > 0;
}

void Table::write() {
  if (left_over_ || changed_ || !is_there(table_file(file_))) {
    hold();
    write_rows();
  }
  if (!journal_) return;
  journal_->remove();
  journal_.reset();
  begun_ = false;
}

void Table::write_rows() {
  std::string text = join_csv(columns_) + '\n';
  std::size_t size = text.size();
  for (const auto& [key, line] : lines_) size += line.size() + 1;
  text.reserve(size);
  for (const auto& [key, line] : lines_) text += line + '\n';
  write_file(file_.string() + kPackedEnding, packed_csv(text));
  std::filesystem::remove(file_);
  left_over_ = changed_ = false;
}

std::optional<std::vector<std::string>> Table::find(const std::vector<std::string>& row) const {
  const auto found = lines_.find(order_of(row));
  if (found == lines_.end()) return std::nullopt;
  return split_csv(found->second);
}

void Table::each(const std::function<void(const std::vector<std::string>&)>& see) const {
  for (const auto& [key, line] : lines_) see(split_csv(line));
}

std::size_t Table::column(const std::string& name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  assert(found != columns_.end());
  return static_cast<std::size_t>(found - columns_.begin());
}

}  // namespace maxwrench
