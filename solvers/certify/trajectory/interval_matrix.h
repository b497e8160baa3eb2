#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "verify/trajectory/jet.h"

// Intervals, with and without derivatives, as scalars of matrices.

namespace maxwrench {

/// An interval that encloses a function, and its derivatives in a few directions, over a box.
struct NarrowDual {
  static constexpr std::size_t kDirections = 4;

  Narrow v;
  std::array<Narrow, kDirections> d{};
  bool varies = false;  ///< otherwise all derivatives are zero

  NarrowDual() = default;
  NarrowDual(const Narrow& constant) : v(constant) {}  // NOLINT: an interval is constant
  NarrowDual(double constant) : v(constant) {}         // NOLINT: so is a number

  friend NarrowDual operator-(NarrowDual x) {
    x.v = -x.v;
    if (x.varies) {
      for (Narrow& slope : x.d) slope = -slope;
    }
    return x;
  }
  friend NarrowDual operator+(NarrowDual x, const NarrowDual& y) { return x += y; }
  friend NarrowDual operator-(NarrowDual x, const NarrowDual& y) { return x += -y; }
  NarrowDual& operator+=(const NarrowDual& y) {
    v += y.v;
    for (std::size_t k = 0; y.varies && k < kDirections; ++k) d[k] += y.d[k];
    varies = varies || y.varies;
    return *this;
  }
  NarrowDual& operator-=(const NarrowDual& y) { return *this += -y; }
  friend NarrowDual operator*(const NarrowDual& x, const NarrowDual& y) {
    NarrowDual product(x.v * y.v);
    product.varies = x.varies || y.varies;
    for (std::size_t k = 0; product.varies && k < kDirections; ++k) {
      if (x.varies) product.d[k] = x.d[k] * y.v;
      if (y.varies) product.d[k] += x.v * y.d[k];
    }
    return product;
  }
};

/// |x| x, which increases.
template <class T>
T signed_square_of(const T& x) {
  return std::abs(x) * x;
}
template <>
inline Narrow signed_square_of(const Narrow& x) {
  return signed_square(Jet<0>(x)).c[0];
}
template <>
inline NarrowDual signed_square_of(const NarrowDual& x) {
  NarrowDual square(signed_square_of(x.v));
  square.varies = x.varies;
  for (std::size_t k = 0; x.varies && k < NarrowDual::kDirections; ++k) {
    Jet<1> along(x.v);
    along.c[1] = x.d[k];
    square.d[k] = signed_square(along).c[1];
  }
  return square;
}

template <class T>
std::array<T, 2> cos_sin_of(const T& x) {
  return {std::cos(x), std::sin(x)};
}
template <>
inline std::array<Narrow, 2> cos_sin_of(const Narrow& x) {
  const CosSin<double> at = enclose(x);
  return {at.c, at.s};
}
template <>
inline std::array<NarrowDual, 2> cos_sin_of(const NarrowDual& x) {
  const CosSin<double> at = enclose(x.v);
  std::array<NarrowDual, 2> both{at.c, at.s};
  for (NarrowDual& each : both) each.varies = x.varies;
  for (std::size_t k = 0; x.varies && k < NarrowDual::kDirections; ++k) {
    both[0].d[k] = -(at.s * x.d[k]);
    both[1].d[k] = at.c * x.d[k];
  }
  return both;
}

}  // namespace maxwrench

namespace Eigen {

/// What Eigen needs to know of a scalar that it does not know.
template <class T>
struct EnclosureTraits : GenericNumTraits<T> {
  using Real = T;
  using NonInteger = T;
  using Nested = T;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 4,
    MulCost = 8
  };
};
template <>
struct NumTraits<maxwrench::Narrow> : EnclosureTraits<maxwrench::Narrow> {};
template <>
struct NumTraits<maxwrench::NarrowDual> : EnclosureTraits<maxwrench::NarrowDual> {};

}  // namespace Eigen
