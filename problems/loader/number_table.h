#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace maxwrench {

/// The numbers of a CSV file, all finite.
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::vector<int> lines;  ///< of the file, in which the rows stand

  /// Rejects a row by its line.
  [[noreturn]] void throw_bad_row(std::size_t row, const std::string& expected) const;

  std::filesystem::path file;
};

/// Reads a CSV file with one of several choices of columns, which differ in number. The first line
/// may be their names. Blank lines count for nothing. Anything else is rejected in one line.
NumberTable read_numbers(const std::filesystem::path& file,
                         const std::vector<std::vector<std::string>>& choices);

}  // namespace maxwrench
