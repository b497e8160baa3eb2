#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/tables/csv.h"

namespace maxwrench {

/// The text of a table such as FOLDER/values.csv, packed or not; empty if it does not exist.
inline std::string read_table(const std::filesystem::path& file) {
  return csv_text(table_file(file));
}

}  // namespace maxwrench
