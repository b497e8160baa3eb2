#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "benchmarks/race/comparison.h"
#include "benchmarks/race/race_summary.h"

namespace maxwrench {

/// One problem, a line for each search, best first.
std::string race_table(const Comparison& comparison);
/// All problems together, a line for each of `rows`, as Markdown; of each of `comparisons`, which
/// may be none or must be those of the standings, the expected ms to a thousandth.
std::string summary_table(std::span<const Standing> rows,
                          std::span<const Comparison> comparisons = {});

/// The values and, apart from them, the times of all attempts, as tables in a folder.
void keep(const Comparison& comparison, const std::filesystem::path& folder);

/// "-" for what is not finite.
std::string number_or_dash(double value, const char* format);

}  // namespace maxwrench
