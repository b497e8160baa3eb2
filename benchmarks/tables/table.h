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

/// A CSV file whose first `key_columns` columns name a row, in the order of these, column by column
/// (whole numbers by their value). Fields with a comma or a quote are quoted; a line break in a
/// field becomes a blank. It is written as FILE.gz, packed; FILE alone is read, too, and replaced.
///
/// Rows go to a journal beside the file, FILE.part, which is not packed, and into the file in the
/// end, so that a row costs the same however many there are. Who is killed leaves the journal; it
/// counts as part of the file.
class Table {
 public:
  /// Keeps the rows of an existing file; they are empty in columns that are new. Writes nothing.
  /// Throws std::invalid_argument on a file that cannot be read, or that is no such table: other
  /// keys, a column that is gone, a line of another length, a last line without its break. Of a
  /// journal such lines are what a killed process left.
  Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns);

  /// Takes hold of the journal until `write`, so that nobody else adds rows, and reads again what
  /// was written since. Throws std::invalid_argument if another process holds it.
  void hold();
  /// Adds a row, in the place of that with the same key, and keeps it in the journal, which it
  /// holds.
  void put(const std::vector<std::string>& row);
  /// The same without the journal: it is kept when the file is written.
  void add(const std::vector<std::string>& row);
  /// Forgets the rows of which `which` is true.
  void drop(const std::function<bool(const std::vector<std::string>&)>& which);
  /// Writes the file, if anything is new or there is none, and removes the journal.
  void write();

  /// That with the same key; the other cells of `row` do not matter.
  std::optional<std::vector<std::string>> find(const std::vector<std::string>& row) const;
  /// All rows in their order.
  void each(const std::function<void(const std::vector<std::string>&)>& see) const;
  std::size_t size() const { return lines_.size(); }
  /// Where a column stands.
  std::size_t column(const std::string& name) const;

 private:
  void read_all();
  /// Whether it has rows.
  bool read(const std::filesystem::path& file, bool whole);
  void write_rows();
  /// Where the columns of an older file stand now.
  std::vector<std::size_t> places_of(const std::filesystem::path& file,
                                     const std::vector<std::string>& before) const;
  std::string order_of(const std::vector<std::string>& row) const;

  std::filesystem::path file_, journal_file_;  ///< without .gz
  std::vector<std::string> columns_;
  std::size_t key_columns_;
  std::map<std::string, std::string> lines_;  ///< by `order_of`
  bool left_over_ = false;                    ///< the journal has rows of who was killed
  bool changed_ = false;                      ///< since the file was written
  bool begun_ = false;                        ///< the journal has this table's rows alone
  std::unique_ptr<Journal> journal_;
};

}  // namespace maxwrench
