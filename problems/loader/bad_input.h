#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "problems/make/bad_value.h"

namespace maxwrench {

/// An invalid value of a file: "FILE: KEY: got VALUE, expected ...", in one line.
class BadInput : public std::invalid_argument {
 public:
  BadInput(const std::filesystem::path& file, const BadValue& value);
  const std::filesystem::path& file() const { return file_; }
  const BadValue& value() const { return value_; }

 private:
  std::filesystem::path file_;
  BadValue value_;
};

/// Throws a `BadInput`.
[[noreturn]] void throw_bad_input(const std::filesystem::path& file, std::string_view key,
                                  std::string_view got, std::string_view expected);

/// Returns the result of `function`. If it rejects a value, throws the error with the file that
/// holds the key. `file_of` returns that file and replaces the key by its name in the file.
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
/// The same if one file holds all keys.
template <class Function>
auto in_file(const std::filesystem::path& file, const Function& function) {
  return in_files([&file](const std::string&) { return file; }, function);
}

/// Whether the path is a regular file. False also for a path that cannot be examined, such as a
/// link to itself.
bool is_file(const std::filesystem::path& path);
/// The same of a folder.
bool is_folder(const std::filesystem::path& path);

/// Opens a regular file. Rejects other paths and files that cannot be read.
std::ifstream open_file(const std::filesystem::path& file, std::string_view expected);

}  // namespace maxwrench
