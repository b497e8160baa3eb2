#pragma once

#include <optional>
#include <string>
#include <vector>

namespace maxwrench {

/// The words of a line of a file in MPS format.
using MpsFields = std::vector<std::string>;

/// Rejects numbers that are not finite. Fortran writes 1.5D+3.
std::optional<double> mps_number(std::string text);

/// Splits a line at its blanks.
MpsFields mps_words(const std::string& line);

/// Joins several words into one name, because the format allows blanks in names.
std::string mps_name(const MpsFields& words, std::size_t first = 0);

/// Splits a line into the fixed columns 2-3, 5-12, 15-22, 25-36, 40-47, 50-61.
MpsFields mps_columns(const std::string& line);

}  // namespace maxwrench
