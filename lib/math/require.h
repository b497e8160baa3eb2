#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

namespace maxwrench {

/// Throws std::invalid_argument "key: got value, expected this" unless `good`.
inline void require(bool good, const char* key, double value, const char* expected) {
  if (good) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  throw std::invalid_argument(std::string(key) + ": got " + text + ", expected " + expected);
}

}  // namespace maxwrench
