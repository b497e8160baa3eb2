#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "benchmarks/race/comparison.h"
#include "benchmarks/race/race_summary.h"

namespace maxwrench {

/// The table of one problem: a line for each search, best first.
std::string race_table(const Comparison& comparison);
/// The table of all problems together, as Markdown: a line for each of `rows`. It has the expected
/// ms to a thousandth for each of `comparisons`, which are empty or those of the standings.
std::string summary_table(std::span<const Standing> rows,
                          std::span<const Comparison> comparisons = {});

/// Writes the values of all attempts, and separately their times, to tables in a folder.
void keep(const Comparison& comparison, const std::filesystem::path& folder);

/// "-" for a number that is not finite.
std::string number_or_dash(double value, const char* format);

}  // namespace maxwrench
