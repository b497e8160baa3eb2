#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/suite/suite_file.h"

namespace maxwrench {

/// Solves cases of a workload in parallel, each on one thread, and writes their rows to the tables
/// of a folder.
void solve_cases(const Workload& work, const std::vector<Case>& cases,
                 const std::filesystem::path& folder, int threads);

}  // namespace maxwrench
