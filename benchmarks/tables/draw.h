#pragma once

#include <cstdint>
#include <vector>

namespace maxwrench {

/// The numbers of `sample` of `all` rows, drawn by `seed` without repetition; all of them if
/// `sample` is 0 or not less.
std::vector<std::size_t> draw_rows(std::size_t all, std::size_t sample, std::uint64_t seed);

}  // namespace maxwrench
