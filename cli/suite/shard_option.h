#pragma once

#include <string>
#include <utility>

namespace maxwrench {

/// I and N of "I/N". Throws std::invalid_argument unless 1 <= I <= N.
std::pair<int, int> parse_shard(const std::string& text);

}  // namespace maxwrench
