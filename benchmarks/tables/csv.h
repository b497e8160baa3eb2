#pragma once

#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace maxwrench {

/// One line of a CSV file without its line break. Fields with a comma or a quote are quoted; a line
/// break in a field becomes a blank.
std::string join_csv(const std::vector<std::string>& fields);
std::vector<std::string> split_csv(const std::string& line);
/// The field without line breaks, as it is written to a file.
std::string one_line(std::string field);

/// The suffix of a packed table's name.
inline constexpr const char* kPackedEnding = ".gz";
/// The file of a table called FILE.csv: FILE.csv.gz, which we write, or FILE.csv. Throws
/// std::invalid_argument if both exist.
std::filesystem::path table_file(const std::filesystem::path& file);
/// The file contents of a table with this text: packed by gzip, the same bytes for the same text.
std::string packed_csv(const std::string& text);
/// The text of a CSV file, packed by gzip or not, whatever its name; empty if there is none. Throws
/// std::invalid_argument with one line if the file is damaged or incomplete, if it unpacks to more
/// than 256 times its size, or if an editor has left a byte order mark or Windows line breaks in
/// it.
std::string csv_text(const std::filesystem::path& file);

/// The columns of a table that were read for an analysis.
struct CsvFile {
  std::filesystem::path file;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  bool has(const std::string& column) const;
  /// A cell by the name of its column, which must exist.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// A cell as a number; nothing for an empty cell or "-". Throws std::invalid_argument if it is
  /// not a finite number.
  std::optional<double> number(std::size_t row, const std::string& column) const;
  /// Throws std::invalid_argument if the cell is not a whole number of zero or more.
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
  /// Throws a line that names file, line, column and cell.
  [[noreturn]] void throw_bad_cell(std::size_t row, const std::string& column,
                                   const std::string& expected) const;
};

/// The line of a row in its file; the first line is the header.
std::size_t line_of(std::size_t row);

/// Reads the columns `required`, and those of `others` that exist. Throws std::invalid_argument
/// with one line like `csv_text`, and if the file cannot be read, has no column of `required`, has
/// a line of another length, or has beside it a journal with rows that are not in it yet.
CsvFile read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
                 const std::vector<std::string>& others = {});

}  // namespace maxwrench
