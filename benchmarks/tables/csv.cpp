#include "benchmarks/tables/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "benchmarks/tables/write_file.h"
#include "verify/packed.h"

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

constexpr std::uint64_t kMostRatio = 256;  // of a table's size to that of its packed file
constexpr int kPackingLevel = 6;           // takes a third of the time of 9 for 1 % more bytes

/// The name of a table without the suffix of a packed one.
std::filesystem::path plain_name(std::filesystem::path file) {
  if (file.extension() == kPackedEnding) file.replace_extension();
  return file;
}

/// Throws if an editor or a spreadsheet has changed the table: its other changes are unknown.
void throw_if_edited(const std::filesystem::path& file, const std::string& text) {
  for (const char* mark : {"\xef\xbb\xbf", "\xff\xfe", "\xfe\xff"}) {
    if (!text.starts_with(mark)) continue;
    throw std::invalid_argument(file.string() +
                                ": line 1: got a byte order mark, expected UTF-8 without one");
  }
  const std::size_t at = text.find('\r');
  if (at == std::string::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  throw std::invalid_argument(fmt::format(
      "{}: line {}: got a carriage return, expected line breaks of Unix (LF, not CR LF)",
      file.string(), line));
}

/// The positions of the requested columns.
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
  throw_bad_cell(row, column, "a finite number or nothing");
}

void CsvFile::throw_bad_cell(std::size_t row, const std::string& column,
                             const std::string& expected) const {
  throw std::invalid_argument(fmt::format("{}: line {}: {}: got '{}', expected {}", file.string(),
                                          line_of(row), column, text(row, column), expected));
}

std::filesystem::path table_file(const std::filesystem::path& file) {
  const std::filesystem::path packed = file.string() + kPackedEnding;
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, error))) return packed;
  if (!std::filesystem::exists(packed, error)) return file;
  throw std::invalid_argument(fmt::format("{}: got {} beside it, expected only one of them",
                                          file.string(), packed.filename().string()));
}

std::string packed_csv(const std::string& text) {
  return pack(text, Wrapping::kGzip, kPackingLevel, kMostRatio);
}

std::string csv_text(const std::filesystem::path& file) {
  std::error_code error;
  std::string text = std::filesystem::is_directory(file, error) ? "" : text_of(file);
  if (is_gzip(text)) {
    std::optional<std::string> unpacked = unpack(text, Wrapping::kGzip, kMostRatio);
    if (!unpacked) {
      throw std::invalid_argument(
          fmt::format("{}: got a damaged file, expected a complete gzip file, at most {} times "
                      "smaller than its text",
                      file.string(), kMostRatio));
    }
    text = std::move(*unpacked);
  }
  throw_if_edited(file, text);
  return text;
}

CsvFile read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
                 const std::vector<std::string>& others) {
  CsvFile csv{file, {}, {}};
  std::error_code error;
  const std::filesystem::path journal = plain_name(file).string() + ".part";
  if (std::filesystem::file_size(journal, error) > 0 && !error) {
    throw std::invalid_argument(
        fmt::format("{}: got rows that are not in {} yet, expected a run that has ended: run it "
                    "again to its end",
                    journal.string(), file.filename().string()));
  }
  std::istringstream in(csv_text(file));
  std::string line;
  if (!std::getline(in, line)) {
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
