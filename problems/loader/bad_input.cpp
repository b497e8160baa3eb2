#include "problems/loader/bad_input.h"

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>
#include <string>
#include <system_error>

namespace maxwrench {

void refuse(const std::filesystem::path& file, std::string_view key, std::string_view got,
            std::string_view expected) {
  constexpr std::size_t kLongest = 120;  // of a shown value
  std::string value(got.substr(0, kLongest));
  if (got.size() > kLongest) value += "...";
  const std::string text =
      fmt::format("{}: {}: got {}, expected {}", file.string(), key, value, expected);
  std::string line;
  for (const char c : text) {  // one line, whatever the value holds
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) line += c;
    if (space && !line.empty() && line.back() != ' ') line += ' ';
  }
  throw std::invalid_argument(line);
}

bool is_file(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

std::ifstream open_file(const std::filesystem::path& file, std::string_view expected) {
  std::ifstream stream;
  if (is_file(file)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) refuse(file, "file", "nothing that can be read", expected);
  return stream;
}

}  // namespace maxwrench
