#pragma once

#include <Eigen/Core>
#include <limits>

// A number type with more digits than double, for the terms of a proof. Model functions are
// templates on the scalar and multiply by constants in double.

namespace maxwrench {

using Extended = long double;
#ifndef __EMSCRIPTEN__  // where there are no bounds
static_assert(std::numeric_limits<Extended>::is_iec559 &&
                  std::numeric_limits<Extended>::digits == 64,
              "bounds: the terms of rounding need a long double of 64 digits, as x86 has");
#endif

}  // namespace maxwrench

namespace Eigen {

template <class Op>
struct ScalarBinaryOpTraits<maxwrench::Extended, double, Op> {
  using ReturnType = maxwrench::Extended;
};
template <class Op>
struct ScalarBinaryOpTraits<double, maxwrench::Extended, Op> {
  using ReturnType = maxwrench::Extended;
};

}  // namespace Eigen
