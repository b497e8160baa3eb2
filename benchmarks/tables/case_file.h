#pragma once

#include <map>
#include <string>
#include <vector>

#include "benchmarks/tables/csv.h"
#include "maxwrench/solve.h"

// Tables whose first columns are the columns of a case.

namespace maxwrench {

/// The columns of a case, followed by `more`.
std::vector<std::string> with_case_columns(const std::vector<std::string>& more);

/// The case of a row. Throws std::invalid_argument, which names the cell, unless seed and budget
/// are whole numbers and the wrench has a valid name.
Case case_of(const CsvFile& csv, std::size_t row);

/// The row of each case, by `case_values`. Throws like `case_of`, and on a case that appears twice.
std::map<std::vector<std::string>, std::size_t> rows_of_cases(const CsvFile& csv);

}  // namespace maxwrench
