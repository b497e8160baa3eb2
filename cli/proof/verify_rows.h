#pragma once

#include <string>

namespace maxwrench {

/// Whether a file begins like values.csv of `run`; throws if it cannot be read.
bool is_values_file(const std::string& file);

/// Checks `sample` rows of such a file, drawn by `seed`, or all if `sample` is 0. Prints the
/// results and returns the exit status.
int verify_rows(const std::string& file, std::size_t sample, std::uint64_t seed, int threads,
                bool json);

}  // namespace maxwrench
