#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace maxwrench {

/// How zlib wraps what it packs, by its own numbers.
enum class Wrapping { kZlib = 15, kGzip = 31 };

/// Whether a file that begins so is packed by gzip.
bool is_gzip(std::string_view text);

/// A text packed by zlib at a level of 1 to 9: the same bytes for the same text, with no name and
/// no time in them. What would become more than `most` times smaller is stored as it is, so that
/// who unpacks it knows how much memory a file can take.
std::string pack(std::string_view text, Wrapping wrapping, int level, std::uint64_t most);

/// The text again. Nothing if the file is damaged, not whole, or unpacks to more than `most` times
/// its size.
std::optional<std::string> unpack(std::string_view packed, Wrapping wrapping, std::uint64_t most);

}  // namespace maxwrench
