#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <stdexcept>

namespace maxwrench {

/// Throws std::invalid_argument unless the times increase and are at least two.
inline void check_times(std::span<const double> times) {
  const bool increase =
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
  if (times.size() < 2 || !increase)
    throw std::invalid_argument("integrator times: expected at least two, increasing");
}

}  // namespace maxwrench
