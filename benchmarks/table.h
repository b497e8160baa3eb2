#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace maxwrench {

/// A CSV file whose first `key_columns` columns name a row. Fields with a comma or a quote are
/// quoted; no field has a line break.
class Table {
 public:
  /// Keeps the rows of an existing file with the same columns.
  Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns);

  /// Replaces the row with the same key in its place, or appends; then writes the file, so that
  /// what was finished before an interruption is never lost.
  void put(const std::vector<std::string>& row);

 private:
  std::filesystem::path file_;
  std::size_t key_columns_;
  std::vector<std::vector<std::string>> lines_;  ///< the header first
};

/// Writes a whole file under a temporary name and renames it; makes the folder. Throws
/// std::invalid_argument that names the file if this fails.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace maxwrench
