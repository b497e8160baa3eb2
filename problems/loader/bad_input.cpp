#include "problems/loader/bad_input.h"

#include <stdexcept>
#include <system_error>

namespace maxwrench {

BadInput::BadInput(const std::filesystem::path& file, const BadValue& value)
    : std::invalid_argument(one_line(file.string() + ": " + value.what())),
      file_(file),
      value_(value) {}

void throw_bad_input(const std::filesystem::path& file, std::string_view key, std::string_view got,
                     std::string_view expected) {
  throw BadInput(file, BadValue(key, got, expected));
}

bool is_file(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

bool is_folder(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_directory(path, none);
}

std::ifstream open_file(const std::filesystem::path& file, std::string_view expected) {
  std::ifstream stream;
  if (is_file(file)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) throw_bad_input(file, "file", "an unreadable file", expected);
  return stream;
}

}  // namespace maxwrench
