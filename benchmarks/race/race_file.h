#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/race/comparison.h"

namespace maxwrench {

/// The targets in names of columns: how far below the best they are (`kTargetShares`).
inline constexpr const char* kTargetNames[] = {"tenth", "hundredth", "thousandth",
                                               "ten_thousandth"};
static_assert(std::size(kTargetNames) == kTargetShares.size());

/// The role of a row in its race: the default search, another contender, or a peer.
inline constexpr const char* kDefaultRole = "default";
inline constexpr const char* kContenderRole = "contender";
inline constexpr const char* kPeerRole = "peer";

/// The races in search_comparison.csv and search_times.csv of a folder, one for each problem,
/// measure, wrench and scheme. The files contain only the rises at a run's targets and at its end.
/// Empty if there are no such files. Throws like `read_results`, and on rows that cannot be of one
/// race: another best value, or a search, solver and seed twice.
std::vector<Comparison> read_races(const std::filesystem::path& folder);

}  // namespace maxwrench
