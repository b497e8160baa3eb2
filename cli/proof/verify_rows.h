#pragma once

#include <string>

namespace maxwrench {

/// Whether a file begins as the values of `run` do; throws if it cannot be read.
bool is_values_file(const std::string& file);

/// Checks all rows of such a file, or `sample` of them, drawn by `seed`; 0: all. Prints what it
/// found, and returns the exit status.
int verify_rows(const std::string& file, std::size_t sample, std::uint64_t seed, int threads,
                bool json);

}  // namespace maxwrench
