#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/suite/journal.h"

namespace maxwrench {

/// A CSV file whose first `key_columns` columns identify a row. Rows are ordered by these columns
/// (whole numbers by their value). Fields with a comma or a quote are quoted; a line break in a
/// field becomes a blank. The file is written packed as FILE.gz; an unpacked FILE is also read, and
/// replaced.
///
/// Rows first go to a journal beside the file, FILE.part, which is not packed, and finally into the
/// file. So adding a row costs the same however many rows there are. A process that is killed
/// leaves the journal behind; it counts as part of the file.
class Table {
 public:
  /// Keeps the rows of an existing file; new columns are empty in them. Writes nothing. Throws
  /// std::invalid_argument on a file that cannot be read or is not such a table: other keys, a
  /// missing column, a line of another length, a last line without its line break. In a journal, a
  /// line of another length or without its break is ignored: a killed process left it.
  Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns);

  /// Locks the journal until `write`, so that no other process adds rows, and reads what others
  /// have written since. Throws std::invalid_argument if another process holds it.
  void hold();
  /// Adds a row, or replaces the row with the same key, and writes it to the journal, which it
  /// locks.
  void put(const std::vector<std::string>& row);
  /// The same without the journal: the row is stored only when the file is written.
  void add(const std::vector<std::string>& row);
  /// Removes the rows for which `which` is true.
  void drop(const std::function<bool(const std::vector<std::string>&)>& which);
  /// Writes the file if there are changes or the file does not exist, and removes the journal.
  void write();

  /// The row with the same key; the other cells of `row` are ignored.
  std::optional<std::vector<std::string>> find(const std::vector<std::string>& row) const;
  /// All rows in their order.
  void each(const std::function<void(const std::vector<std::string>&)>& see) const;
  std::size_t size() const { return lines_.size(); }
  /// The position of a column.
  std::size_t column(const std::string& name) const;

 private:
  void read_all();
  /// Returns whether the file has rows.
  bool read(const std::filesystem::path& file, bool whole);
  void write_rows();
  /// The present positions of an older file's columns.
  std::vector<std::size_t> places_of(const std::filesystem::path& file,
                                     const std::vector<std::string>& before) const;
  std::string order_of(const std::vector<std::string>& row) const;

  std::filesystem::path file_, journal_file_;  ///< without .gz
  std::vector<std::string> columns_;
  std::size_t key_columns_;
  std::map<std::string, std::string> lines_;  ///< by `order_of`
  bool left_over_ = false;                    ///< the journal has rows of a killed process
  bool changed_ = false;                      ///< since the file was written
  bool begun_ = false;                        ///< the journal contains only this table's rows
  std::unique_ptr<Journal> journal_;
};

}  // namespace maxwrench
