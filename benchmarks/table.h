#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace maxwrench {

/// A CSV file whose first `key_columns` columns name a row. Fields with a comma or a quote are
/// quoted; a line break in a field becomes a blank.
class Table {
 public:
  /// Keeps the rows of an existing file with the same keys if none of its columns is gone; they are
  /// empty in columns that are new. Throws std::invalid_argument on a file that cannot be read.
  Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns);

  /// Replaces the row with the same key in its place, or appends; then writes the file, so that
  /// what was finished before an interruption is never lost.
  void put(const std::vector<std::string>& row);

 private:
  /// Where the columns of an older file stand now; empty if one is gone or the keys differ.
  std::vector<std::size_t> places_of(const std::vector<std::string>& before) const;

  std::filesystem::path file_;
  std::size_t key_columns_;
  std::vector<std::vector<std::string>> lines_;  ///< the header first
};

}  // namespace maxwrench
