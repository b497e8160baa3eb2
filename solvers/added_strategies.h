#pragma once

#include <vector>

namespace maxwrench {

struct MeasureEntry;
struct SearchEntry;

/// The newest entry of each name that `add_measure` got, in the order in which the names came. An
/// entry lives as long as the program.
std::vector<const MeasureEntry*> added_measures();

/// As `added_measures`, for `add_search`.
std::vector<const SearchEntry*> added_searches();

}  // namespace maxwrench
