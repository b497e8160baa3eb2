#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace maxwrench {

/// The format of packed data, by the numbers that zlib uses.
enum class Wrapping { kZlib = 15, kGzip = 31 };

/// Whether a file that begins with this text is packed by gzip.
bool is_gzip(std::string_view text);

/// Packs a text with zlib at a level of 1 to 9. The same text gives the same bytes, which contain
/// no name and no time. A text that would become more than `most` times smaller is stored without
/// compression. A reader can therefore limit the memory that a file needs.
std::string pack(std::string_view text, Wrapping wrapping, int level, std::uint64_t most);

/// Unpacks a text. Empty if the file is damaged or incomplete, or unpacks to more than `most` times
/// its size.
std::optional<std::string> unpack(std::string_view packed, Wrapping wrapping, std::uint64_t most);

}  // namespace maxwrench
