#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/suite/map_rows.h"

namespace maxwrench {

/// The cells of a map in a folder: map.csv.gz, a row for each cell, and map.json, which says what
/// map it is. Rows are kept as soon as they are put, see `Table`.
class MapStore {
 public:
  /// Reads the cells that a folder has, and locks it. The cells count as known if the folder
  /// belongs to the same map and, unless `again`, to the same version.
  ///
  /// Throws std::invalid_argument if the folder belongs to another map or a file cannot be read.
  MapStore(const std::filesystem::path& folder, const Problem& task, const MapPlan& plan,
           const Case& choice, bool again);

  /// A cell that was known at the beginning. Its posture is evaluated again. May be called from any
  /// thread.
  ///
  /// Throws std::invalid_argument unless the posture has the value of the cell.
  std::optional<MapCell> find(const std::vector<long>& index) const;
  /// The number of those cells.
  std::size_t known() const { return known_.size(); }
  /// Adds a cell. One call at a time.
  void put(const MapCell& cell);
  /// Writes the table.
  void write() { table_.write(); }

 private:
  const MapRows rows_;
  Table table_;
  std::map<std::vector<long>, MapCell> known_;
};

/// Whether a folder holds a map.
bool holds_map(const std::filesystem::path& folder);

/// Joins the maps of several folders, such as those of shards, in the folder `out`. Returns the
/// number of cells. Throws std::invalid_argument if they are not of one map, if a cell has two
/// values, or if a map is still being written.
std::size_t merge_maps(const std::filesystem::path& out, const std::vector<std::string>& folders);

}  // namespace maxwrench
