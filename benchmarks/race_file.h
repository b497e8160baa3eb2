#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/comparison.h"

namespace maxwrench {

/// In names of columns: how far below the best the targets are (`kTargetShares`).
inline constexpr const char* kTargetNames[] = {"tenth", "hundredth", "thousandth",
                                               "ten_thousandth"};
static_assert(std::size(kTargetNames) == kTargetShares.size());

/// The races in search_comparison.csv and search_times.csv of a folder, one for each problem,
/// measure, wrench and scheme, as far as the files tell: a run rises at its targets and at its end
/// only. Contenders are the rows of the solver that most have, the others are peers. None if there
/// are no such files; throws as `read_results`.
std::vector<Comparison> read_races(const std::filesystem::path& folder);

}  // namespace maxwrench
