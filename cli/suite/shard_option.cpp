#include "cli/suite/shard_option.h"

#include <fmt/format.h>

#include <stdexcept>

namespace maxwrench {

std::pair<int, int> parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = [](const std::string& digits) {
    const bool whole = !digits.empty() && digits.size() < 7 &&
                       digits.find_first_not_of("0123456789") == std::string::npos;
    return whole ? std::stoi(digits) : 0;
  };
  const int index = number(text.substr(0, slash));
  const int count = slash == std::string::npos ? 0 : number(text.substr(slash + 1));
  if (index < 1 || index > count) {
    throw std::invalid_argument(
        fmt::format("shard: got '{}', expected I/N such as 2/4, with I from 1 to N", text));
  }
  return {index, count};
}

}  // namespace maxwrench
