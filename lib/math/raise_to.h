#pragma once

#include <cmath>

#include "maxwrench/types.h"

namespace maxwrench {

/// Raises `worst` to `value`; NaN counts as infinity.
inline void raise_to(double& worst, double value) {
  if (!(value <= worst)) worst = std::isnan(value) ? kInfinity : value;
}

}  // namespace maxwrench
