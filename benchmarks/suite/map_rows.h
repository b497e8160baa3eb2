#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/tables/table.h"
#include "maxwrench/map.h"
#include "maxwrench/problem.h"
#include "solvers/map/lattice.h"

namespace maxwrench {

/// The files of a map in its folder.
inline constexpr const char* kMapTable = "map.csv";
inline constexpr const char* kMapSettings = "map.json";

/// The rows of map.csv: their columns, and the cells that they stand for.
class MapRows {
 public:
  MapRows(const Problem& task, const MapPlan& plan, const Case& choice);

  const std::vector<std::string>& columns() const { return columns_; }
  /// The number of coordinates, whose columns identify a row.
  std::size_t axes() const { return axes_; }
  std::vector<std::string> row_of(const MapCell& cell) const;
  /// Throws std::invalid_argument if the row is none.
  MapCell read(const std::vector<std::string>& row) const;
  /// Evaluates the posture of a cell again. Empty, or the cell and what is wrong with it: the
  /// coordinates are not those of its place, the posture does not have its value, or a bound is
  /// below it. May be called from any thread.
  std::string fault(const MapCell& cell) const;

 private:
  const Problem task_;
  const std::vector<MapAxis> over_;
  const Case choice_;
  const Lattice lattice_;
  std::vector<std::string> columns_;
  std::size_t axes_, theta_r_, joints_;
  std::string seed_;
};

/// The number in a cell of the table. Throws std::invalid_argument unless it is finite or "-inf".
double map_number(const std::string& text);
/// The same where an empty text stands for `none`.
double map_number(const std::string& text, double none);

}  // namespace maxwrench
