#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/race/comparison.h"

namespace maxwrench {

/// In names of columns: how far below the best the targets are (`kTargetShares`).
inline constexpr const char* kTargetNames[] = {"tenth", "hundredth", "thousandth",
                                               "ten_thousandth"};
static_assert(std::size(kTargetNames) == kTargetShares.size());

/// What a row is in its race: the default search, another contender, or a peer.
inline constexpr const char* kDefaultRole = "default";
inline constexpr const char* kContenderRole = "contender";
inline constexpr const char* kPeerRole = "peer";

/// The races in search_comparison.csv and search_times.csv of a folder, one for each problem,
/// measure, wrench and scheme, as far as the files tell: a run rises at its targets and at its end
/// only. None if there are no such files; throws as `read_results`, and on rows of one race that
/// cannot be of one: another best value, or a search, solver and seed twice.
std::vector<Comparison> read_races(const std::filesystem::path& folder);

}  // namespace maxwrench
