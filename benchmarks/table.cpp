#include "benchmarks/table.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "benchmarks/write_file.h"

namespace maxwrench {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c == '\n' || c == '\r' ? ' ' : c;
  }
  return text + '"';
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool doubled = inside && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled) fields.back() += line[++i];
      if (!doubled) inside = !inside;
    } else if (line[i] == ',' && !inside) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

/// Whether there is a file to read. One that cannot be read must not be mistaken for none: writing
/// would lose its rows.
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
                              "', expected a table of ours or no file");
}

}  // namespace

Table::Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns)
    : file_(std::move(file)), key_columns_(key_columns), lines_{std::move(columns)} {
  if (!is_there(file_)) return;
  std::ifstream in(file_);
  std::string line;
  if (!std::getline(in, line)) return;
  const std::vector<std::string> before = split(line);
  const std::vector<std::size_t> places = places_of(before);
  if (places.empty()) return;
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = split(line);
    if (fields.size() != before.size()) continue;
    lines_.emplace_back(lines_.front().size());
    for (std::size_t i = 0; i < places.size(); ++i) lines_.back()[places[i]] = fields[i];
  }
}

std::vector<std::size_t> Table::places_of(const std::vector<std::string>& before) const {
  const std::vector<std::string>& now = lines_.front();
  const auto keys = static_cast<std::ptrdiff_t>(key_columns_);
  if (before.size() < key_columns_ || !std::equal(now.begin(), now.begin() + keys, before.begin()))
    return {};
  std::vector<std::size_t> places;
  for (const std::string& column : before) {
    const auto found = std::find(now.begin(), now.end(), column);
    if (found == now.end()) return {};
    places.push_back(static_cast<std::size_t>(found - now.begin()));
  }
  return places;
}

void Table::put(const std::vector<std::string>& row) {
  const auto key_end = static_cast<std::ptrdiff_t>(key_columns_);
  const auto found = std::find_if(lines_.begin() + 1, lines_.end(), [&](const auto& other) {
    return std::equal(row.begin(), row.begin() + key_end, other.begin());
  });
  if (found != lines_.end()) {
    *found = row;
  } else {
    lines_.push_back(row);
  }
  std::string text;
  for (const auto& line : lines_) {
    for (std::size_t i = 0; i < line.size(); ++i) text += (i ? "," : "") + quoted(line[i]);
    text += '\n';
  }
  write_file(file_, text);
}

}  // namespace maxwrench
