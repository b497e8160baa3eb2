#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "problems/make/bad_value.h"

namespace maxwrench {

/// Throws std::invalid_argument with one line: `<file>: <key>: got <got>, expected <expected>`.
[[noreturn]] void throw_bad_input(const std::filesystem::path& file, std::string_view key,
                                  std::string_view got, std::string_view expected);

/// What `function` returns. Where it rejects a value, `file_of` names the file that holds the key,
/// and puts the key as it stands there.
template <class FileOf, class Function>
auto in_files(const FileOf& file_of, const Function& function) {
  try {
    return function();
  } catch (const BadValue& bad) {
    std::string key = bad.key();
    const std::filesystem::path file = file_of(key);
    throw_bad_input(file, key, bad.got(), bad.expected());
  }
}
/// The same where one file holds all keys.
template <class Function>
auto in_file(const std::filesystem::path& file, const Function& function) {
  return in_files([&file](const std::string&) { return file; }, function);
}

/// Whether it is a regular file; what cannot be looked at, such as a link that leads to itself, is
/// none.
bool is_file(const std::filesystem::path& path);

/// Opens a regular file, or rejects what is none or cannot be read.
std::ifstream open_file(const std::filesystem::path& file, std::string_view expected);

}  // namespace maxwrench
