#pragma once

#include <filesystem>
#include <string>

namespace maxwrench {

/// [bytes] The longest file that is read.
inline constexpr std::size_t kLongestMesh = 200'000'000;

/// Reads a whole file. Rejects what is not a regular file, and files longer than kLongestMesh.
std::string read_mesh_file(const std::filesystem::path& file);

/// Rejects what would make Assimp take memory or time without bound, or overflow its stack: counts
/// that the file does not hold, deep nesting, and nodes that contain themselves or multiply. Cuts
/// off what follows the triangles of a binary STL.
///
/// The extension is in lower case, with its dot.
void check_mesh_text(const std::filesystem::path& file, const std::string& extension,
                     std::string& text);

/// Throws std::invalid_argument: `<file>: mesh: got <got>, expected <expected>`.
[[noreturn]] void throw_bad_mesh(const std::filesystem::path& file, const std::string& got,
                                 const std::string& expected);

}  // namespace maxwrench
