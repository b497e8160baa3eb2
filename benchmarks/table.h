#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/journal.h"

namespace maxwrench {

/// A CSV file whose first `key_columns` columns name a row, in the order of these, column by column
/// (whole numbers by their value). Fields with a comma or a quote are quoted; a line break in a
/// field becomes a blank.
///
/// Rows go to a journal beside the file, FILE.part, and into the file in the end, so that a row
/// costs the same however many there are. Who is killed leaves the journal; it counts as part of
/// the file.
class Table {
 public:
  /// Keeps the rows of an existing file with the same keys if none of its columns is gone; they are
  /// empty in columns that are new. Writes nothing. Throws std::invalid_argument on a file that
  /// cannot be read.
  Table(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns);

  /// Adds a row, in the place of that with the same key, and keeps it in the journal.
  void put(const std::vector<std::string>& row);
  /// The same without the journal: it is kept when the file is written.
  void add(const std::vector<std::string>& row);
  /// Writes the file and removes the journal; nothing if nothing is new.
  void write();

  /// That with the same key; the other cells of `row` do not matter.
  std::optional<std::vector<std::string>> find(const std::vector<std::string>& row) const;
  /// All rows in their order.
  void each(const std::function<void(const std::vector<std::string>&)>& see) const;
  std::size_t size() const { return lines_.size(); }
  /// Where a column stands.
  std::size_t column(const std::string& name) const;

 private:
  /// Whether there was such a file.
  bool read(const std::filesystem::path& file);
  /// Where the columns of an older file stand now; empty if one is gone or the keys differ.
  std::vector<std::size_t> places_of(const std::vector<std::string>& before) const;
  std::string order_of(const std::vector<std::string>& row) const;

  std::filesystem::path file_, journal_file_;
  std::vector<std::string> columns_;
  std::size_t key_columns_;
  std::map<std::string, std::string> lines_;  ///< by `order_of`
  bool left_over_ = false;                    ///< there is a journal of who was killed
  bool changed_ = false;                      ///< since the file was written
  std::unique_ptr<Journal> journal_;
};

}  // namespace maxwrench
