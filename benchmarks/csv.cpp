#include "benchmarks/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace maxwrench {
namespace {

std::string quoted_field(const std::string& field) {
  const std::string line = one_line(field);
  if (line.find_first_of(",\"") == std::string::npos) return line;
  std::string text = "\"";
  for (const char c : line) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

/// Where the columns that are to be read stand.
std::vector<std::size_t> chosen_places(const std::filesystem::path& file,
                                       const std::vector<std::string>& header,
                                       const std::vector<std::string>& required,
                                       const std::vector<std::string>& others) {
  std::vector<std::size_t> places;
  for (const auto* names : {&required, &others}) {
    for (const std::string& name : *names) {
      const auto found = std::find(header.begin(), header.end(), name);
      if (found != header.end()) {
        places.push_back(static_cast<std::size_t>(found - header.begin()));
      } else if (names == &required) {
        throw std::invalid_argument(
            fmt::format("{}: line 1: got no column '{}', expected one", file.string(), name));
      }
    }
  }
  return places;
}

}  // namespace

std::string one_line(std::string field) {
  std::replace_if(
      field.begin(), field.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return field;
}

std::string join_csv(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) line += (i ? "," : "") + quoted_field(fields[i]);
  return line;
}

std::vector<std::string> split_csv(const std::string& line) {
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

std::size_t line_of(std::size_t row) { return row + 2; }

bool CsvFile::has(const std::string& column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

const std::string& CsvFile::text(std::size_t row, const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return rows[row][static_cast<std::size_t>(found - columns.begin())];
}

std::optional<double> CsvFile::number(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  if (cell.empty() || cell == "-") return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value)) {
    return value;
  }
  refuse(row, column, "a finite number or nothing");
}

void CsvFile::refuse(std::size_t row, const std::string& column,
                     const std::string& expected) const {
  throw std::invalid_argument(fmt::format("{}: line {}: {}: got '{}', expected {}", file.string(),
                                          line_of(row), column, text(row, column), expected));
}

CsvFile read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
                 const std::vector<std::string>& others) {
  CsvFile csv{file, {}, {}};
  std::error_code error;
  const std::filesystem::path journal = file.string() + ".part";
  if (std::filesystem::file_size(journal, error) > 0 && !error) {
    throw std::invalid_argument(
        fmt::format("{}: got rows that are not in {} yet, expected a run that has ended: run it "
                    "again to its end",
                    journal.string(), file.filename().string()));
  }
  std::ifstream in;
  if (!std::filesystem::is_directory(file, error)) in.open(file);
  std::string line;
  if (!in.is_open() || !std::getline(in, line)) {
    throw std::invalid_argument(file.string() +
                                ": got no table, expected one that `run` or `compare` wrote");
  }
  const std::vector<std::string> header = split_csv(line);
  const std::vector<std::size_t> places = chosen_places(file, header, required, others);
  for (const std::size_t place : places) csv.columns.push_back(header[place]);
  while (std::getline(in, line)) {
    std::vector<std::string> fields = split_csv(line);
    if (fields.size() != header.size()) {
      throw std::invalid_argument(fmt::format("{}: line {}: got {} fields, expected {}",
                                              file.string(), line_of(csv.rows.size()),
                                              fields.size(), header.size()));
    }
    std::vector<std::string>& row = csv.rows.emplace_back();
    for (const std::size_t place : places) row.push_back(std::move(fields[place]));
  }
  return csv;
}

}  // namespace maxwrench
