#pragma once

#include <cstdint>
#include <string_view>

namespace maxwrench {

/// The 64-bit FNV-1a hash of a text; with the hash of an earlier text, that of both one after the
/// other.
inline std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

}  // namespace maxwrench
