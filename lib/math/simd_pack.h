#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

// Loops over long vectors, a few numbers at a time, so that sums and comparisons stay in registers.

namespace maxwrench {

template <int L>
using SimdPack = Eigen::Array<double, L, 1>;
inline constexpr int kPackSize = 4;

template <int L>
Eigen::Map<const SimdPack<L>> pack(const double* x) {
  return Eigen::Map<const SimdPack<L>>(x);
}
template <int L>
Eigen::Map<SimdPack<L>> pack(double* x) {
  return Eigen::Map<SimdPack<L>>(x);
}

/// Calls body<L>(i) for blocks of L numbers from i on, until all `size` numbers are covered.
template <int Most = kPackSize, class Body>
EIGEN_ALWAYS_INLINE void for_packs(Eigen::Index size, Body&& body) {
  Eigen::Index i = 0;
  for (; i + Most <= size; i += Most) body.template operator()<Most>(i);
  for (; i < size; ++i) body.template operator()<1>(i);
}

/// A sum and a maximum. Numbers that do not fill a pack are accumulated separately, so that packs
/// stay in registers.
template <int Most = kPackSize>
struct PackSum {
  SimdPack<Most> sums = SimdPack<Most>::Zero();
  double rest = 0;
  template <class X>
  void add(const X& x) {
    if constexpr (X::RowsAtCompileTime == Most) {
      sums += x;
    } else {
      rest += x.value();
    }
  }
  double value() const { return sums.sum() + rest; }
};
struct PackMax {
  SimdPack<kPackSize> most = SimdPack<kPackSize>::Constant(-std::numeric_limits<double>::max());
  double rest = -std::numeric_limits<double>::max();
  template <class X>
  void add(const X& x) {
    if constexpr (X::RowsAtCompileTime == kPackSize) {
      most = most.max(x);
    } else {
      rest = std::max(rest, x.value());
    }
  }
  double value() const { return std::max(most.maxCoeff(), rest); }
};

}  // namespace maxwrench
