#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace maxwrench {

/// The numbers of a CSV file, all of them finite.
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::vector<int> lines;  ///< line of each row in the file

  /// Rejects a row with its line number.
  [[noreturn]] void throw_bad_row(std::size_t row, const std::string& expected) const;

  std::filesystem::path file;
};

/// Reads a CSV file with one of several lists of columns, which differ in length. The first line
/// may contain the column names. Blank lines are skipped. Anything else is rejected with a message
/// of one line.
NumberTable read_numbers(const std::filesystem::path& file,
                         const std::vector<std::vector<std::string>>& choices);

/// Reads a CSV file whose first line has the names of its columns, whatever they are. Otherwise as
/// `read_numbers`.
NumberTable read_named_numbers(const std::filesystem::path& file);

}  // namespace maxwrench
