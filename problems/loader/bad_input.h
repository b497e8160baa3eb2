#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace maxwrench {

/// Throws std::invalid_argument with one line: `<file>: <key>: got <got>, expected <expected>`.
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view key,
                         std::string_view got, std::string_view expected);

/// Whether it is a regular file; what cannot be looked at, such as a link that leads to itself, is
/// none.
bool is_file(const std::filesystem::path& path);

/// Opens a regular file, or refuses what is none or cannot be read.
std::ifstream open_file(const std::filesystem::path& file, std::string_view expected);

}  // namespace maxwrench
