#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace maxwrench {

/// Writes a whole file; all files that the command writes go through here. Below this floor nothing
/// writes files: what has a form of its own (MPS, SVG, CSV) is handed up as text.
///
/// A regular file, new or old, is written under a temporary name in its folder (which is made if it
/// is missing) and renamed, so that it is whole or untouched; symbolic links are followed. Anything
/// else (a device, a pipe) is written to as a stream, and so is what stdout or stderr already stand
/// for. Throws std::invalid_argument with one line that names the file and the system's reason;
/// nothing is left behind then.
void write_file(const std::filesystem::path& file, const std::string& text);

/// All of a file; empty if there is none, or it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// The line that `write_file` throws, for an `errno`.
[[noreturn]] void throw_output_error(const std::filesystem::path& file, int error);
/// All of a text to an open file; zero or the `errno`.
int write_all(int descriptor, std::string_view text);

}  // namespace maxwrench
