#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

// Loops over long vectors, a few numbers at a time: what is added up or compared stays in
// registers.

namespace maxwrench {

template <int L>
using Lanes = Eigen::Array<double, L, 1>;
inline constexpr int kLaneCount = 4;

template <int L>
Eigen::Map<const Lanes<L>> lanes(const double* x) {
  return Eigen::Map<const Lanes<L>>(x);
}
template <int L>
Eigen::Map<Lanes<L>> lanes(double* x) {
  return Eigen::Map<Lanes<L>>(x);
}

/// Calls body<L>(i) for the `size` numbers, L of them from i on.
template <int Most = kLaneCount, class Body>
EIGEN_ALWAYS_INLINE void for_lanes(Eigen::Index size, Body&& body) {
  Eigen::Index i = 0;
  for (; i + Most <= size; i += Most) body.template operator()<Most>(i);
  for (; i < size; ++i) body.template operator()<1>(i);
}

/// A sum, and the largest of numbers. What does not fill the lanes is apart: registers again.
template <int Most = kLaneCount>
struct LaneSum {
  Lanes<Most> sums = Lanes<Most>::Zero();
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
struct LaneMost {
  Lanes<kLaneCount> most = Lanes<kLaneCount>::Constant(-std::numeric_limits<double>::max());
  double rest = -std::numeric_limits<double>::max();
  template <class X>
  void add(const X& x) {
    if constexpr (X::RowsAtCompileTime == kLaneCount) {
      most = most.max(x);
    } else {
      rest = std::max(rest, x.value());
    }
  }
  double value() const { return std::max(most.maxCoeff(), rest); }
};

}  // namespace maxwrench
