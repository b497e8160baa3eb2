#pragma once

#include <Eigen/Core>

// Numbers of more digits than double, for what a proof is made of: model functions are templates on
// the scalar, and multiply by constants in double.

namespace maxwrench {

using Extended = long double;

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
