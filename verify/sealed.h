#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace maxwrench {

/// The contents of a certificate file: its first line, the CRC-32 of everything after it, the
/// length of `raw`, and `raw` packed by zlib; little endian.
std::string seal(std::string_view first_line, const std::string& raw);

/// Whether a file begins with this line. False if it cannot be read.
bool begins_with(const std::string& file, std::string_view first_line);

/// Reads such a file. Empty if it is damaged. The first line is checked before the rest is read,
/// because the rest may be endless.
///
/// @throws std::invalid_argument, in one line with the name of the file, if the file cannot be read
///         or begins differently.
std::string unseal(const std::string& file, std::string_view first_line);

/// The FNV-1a hash of bytes.
std::uint64_t digest_of(std::string_view bytes);

/// Whether a text can be printed in a line.
bool fits_in_a_line(const std::string& text);

}  // namespace maxwrench
