#pragma once

#include <type_traits>

namespace maxwrench {

// Short rows of numbers, padded with zeros so that loops over them vectorise without a remainder.
// The length of the shortest row, for which this matters most, is a compile-time constant.

/// The length of a row that holds `count` numbers.
constexpr int padded(int count) { return count <= 2 ? 2 : (count + 3) / 4 * 4; }

/// Calls body(length); a length of two is a compile-time constant.
template <class Body>
void with_length(int length, Body&& body) {
  if (length == 2) {
    body(std::integral_constant<int, 2>{});
  } else {
    body(length);
  }
}

/// How many numbers are processed together: a divisor of the length.
template <class Length>
constexpr int kLanes = std::is_same_v<Length, int> ? 4 : 2;

/// x += a y.
template <class Length>
inline void add_multiple(double* __restrict x, double a, const double* __restrict y, Length n) {
  for (int i = 0; i < n; i += kLanes<Length>) {
    for (int pack = 0; pack < kLanes<Length>; ++pack) x[i + pack] += a * y[i + pack];
  }
}

/// x'y.
template <class Length>
inline double dot(const double* __restrict x, const double* __restrict y, Length n) {
  double sums[kLanes<Length>] = {};
  for (int i = 0; i < n; i += kLanes<Length>) {
    for (int pack = 0; pack < kLanes<Length>; ++pack) sums[pack] += x[i + pack] * y[i + pack];
  }
  double sum = sums[0] + sums[1];
  for (int pack = 2; pack < kLanes<Length>; pack += 2) sum += sums[pack] + sums[pack + 1];
  return sum;
}

}  // namespace maxwrench
