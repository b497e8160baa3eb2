#include "benchmarks/table.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace maxwrench {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
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

}  // namespace

Table::Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns)
    : file_(std::move(file)), key_columns_(key_columns), lines_{std::move(columns)} {
  std::ifstream in(file_);
  std::string line;
  if (!std::getline(in, line) || split(line) != lines_.front()) return;
  while (std::getline(in, line)) {
    if (split(line).size() == lines_.front().size()) lines_.push_back(split(line));
  }
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

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  std::filesystem::path temporary = file;
  temporary += ".part";
  {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) {
      throw std::invalid_argument(file.string() +
                                  ": cannot be written, expected a writable folder");
    }
  }
  std::filesystem::rename(temporary, file, error);
  if (error) throw std::invalid_argument(file.string() + ": " + error.message());
}

}  // namespace maxwrench
