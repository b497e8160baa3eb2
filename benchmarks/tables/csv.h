#pragma once

#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace maxwrench {

/// One line of a CSV file without its break. Fields with a comma or a quote are quoted; a line
/// break in a field becomes a blank.
std::string join_csv(const std::vector<std::string>& fields);
std::vector<std::string> split_csv(const std::string& line);
/// Without line breaks: as it stands in a file.
std::string one_line(std::string field);

/// Of the name of a packed table.
inline constexpr const char* kPackedEnding = ".gz";
/// Where a table called FILE.csv is: FILE.csv.gz, as we write it, or FILE.csv. Throws
/// std::invalid_argument if both are there.
std::filesystem::path table_file(const std::filesystem::path& file);
/// What a table of this text is as a file: packed by gzip, the same bytes for the same text.
std::string packed_csv(const std::string& text);
/// All of a CSV file, packed by gzip or not, whatever its name; empty if there is none. Throws
/// std::invalid_argument with one line on one that is damaged or not whole, that unpacks to more
/// than 256 times its size, or that has been through an editor that leaves a byte order mark or
/// line breaks of Windows.
std::string csv_text(const std::filesystem::path& file);

/// Columns of a table as they are read for analysis.
struct CsvFile {
  std::filesystem::path file;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  bool has(const std::string& column) const;
  /// A cell by the name of its column, which exists.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// Nothing for an empty cell or "-". Throws std::invalid_argument on what is no finite number.
  std::optional<double> number(std::size_t row, const std::string& column) const;
  /// Throws std::invalid_argument on what is no whole number of zero or more.
  template <class Integer>
  Integer whole(std::size_t row, const std::string& column) const {
    const std::string& cell = text(row, column);
    Integer value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || value < 0) {
      throw_bad_cell(row, column, "a whole number");
    }
    return value;
  }
  /// A line that names file, line, column and cell.
  [[noreturn]] void throw_bad_cell(std::size_t row, const std::string& column,
                                   const std::string& expected) const;
};

/// The line of a row in its file, where the first one is the header.
std::size_t line_of(std::size_t row);

/// Reads the columns that are `required`, and of `others` those that are there. Throws
/// std::invalid_argument with one line as `csv_text` does, and on a file that cannot be read, that
/// lacks one of `required`, with a line of another length, or beside a journal of rows that are not
/// in it yet.
CsvFile read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
                 const std::vector<std::string>& others = {});

}  // namespace maxwrench
