#pragma once

#include <filesystem>
#include <string_view>

namespace maxwrench {

/// Throws std::invalid_argument with one line: `<file>: <key>: got <got>, expected <expected>`.
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view key,
                         std::string_view got, std::string_view expected);

}  // namespace maxwrench
