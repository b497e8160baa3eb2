#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace maxwrench {

/// Writes a whole file. The command writes all its files through this function. Lower layers write
/// no files: they return formats of their own (MPS, SVG, CSV) as text.
///
/// A regular file, new or old, is written under a temporary name in its folder (which is created if
/// it is missing) and then renamed, so it is complete or unchanged; symbolic links are followed.
/// Anything else (a device, a pipe) is written as a stream, and so are the files of stdout and
/// stderr. Throws std::invalid_argument with one line that names the file and the system's reason;
/// then nothing is left behind.
void write_file(const std::filesystem::path& file, const std::string& text);

/// The contents of a file; empty if it does not exist or cannot be read.
std::string text_of(const std::filesystem::path& file);

/// Throws the error line of `write_file` for an `errno`.
[[noreturn]] void throw_output_error(const std::filesystem::path& file, int error);
/// Writes a whole text to an open file; returns zero or the `errno`.
int write_all(int descriptor, std::string_view text);

}  // namespace maxwrench
