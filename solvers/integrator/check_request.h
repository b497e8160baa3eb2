#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <stdexcept>

#include "maxwrench/integrator.h"

namespace maxwrench {

/// Throws std::invalid_argument unless there are at least two times, finite and increasing, and the
/// options are valid.
inline void check_request(const IntegratorOptions& options, std::span<const double> times) {
  const bool increase =
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
  const bool finite =
      std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); });
  if (times.size() < 2 || !increase || !finite)
    throw std::invalid_argument("integrator times: expected at least two, finite and increasing");
  check(options);
}

}  // namespace maxwrench
