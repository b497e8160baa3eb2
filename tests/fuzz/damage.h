#pragma once

#include <span>
#include <string>

#include "lib/math/random.h"

namespace maxwrench {

/// Uniform among low .. high.
inline int whole(Random& random, int low, int high) {
  return low + static_cast<int>(random.next() % static_cast<std::uint64_t>(high - low + 1));
}

/// The text with one to six of its bytes, words or numbers exchanged, doubled or lost. `words` are
/// what the format is made of.
std::string damaged(std::string text, std::span<const char* const> words, Random& random);

}  // namespace maxwrench
