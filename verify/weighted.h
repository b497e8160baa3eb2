#pragma once

#include "maxwrench/zonotope.h"
#include "verify/wide_matrix.h"

namespace maxwrench {

/// An enclosure of the maximum of u slope over u in [min, max].
inline Narrow larger(const Narrow& slope, double min, double max) {
  const Narrow a = min * slope, b = max * slope;
  return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

/// W_u B^+, m×n: each effort as a share of the smaller of its limits.
inline WideRows weighted_pseudoinverse(const Zonotope& set) {
  WideRows K = enclose_pseudoinverse(set.B);
  for (std::size_t k = 0; k < K.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const Wide limit(std::min(std::abs(set.u_min[at]), std::abs(set.u_max[at])));
    for (Wide& x : K[k]) x = x / limit;
  }
  return K;
}

}  // namespace maxwrench
