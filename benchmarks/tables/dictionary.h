#pragma once

#include <span>
#include <string>

namespace maxwrench {

/// The meaning of a column of our CSV files; a name means the same in all of them.
struct ColumnMeaning {
  const char* column;
  const char* unit;  ///< empty: a name, a count or a share
  const char* meaning;
};

/// All columns of all tables that `run`, `compare` and `report` write.
std::span<const ColumnMeaning> dictionary();

/// Null if the dictionary has no such column.
const ColumnMeaning* find_meaning(const std::string& column);

}  // namespace maxwrench
