#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/suite/suite_file.h"

namespace maxwrench {

/// Solves cases of a workload side by side, each on one thread, and keeps their rows in the tables
/// of a folder.
void solve_cases(const Workload& work, const std::vector<Case>& cases,
                 const std::filesystem::path& folder, int threads);

}  // namespace maxwrench
