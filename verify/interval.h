#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

// Every enclosure below relies on IEEE 754 arithmetic that rounds to nearest. The build fails if
// the compiler does not provide it.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "verify: the interval arithmetic needs IEEE 754: build without -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0,
              "verify: the interval arithmetic needs doubles without excess precision");
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "verify: the interval arithmetic needs IEEE 754 doubles");
static_assert(std::numeric_limits<long double>::is_iec559 &&
                  std::numeric_limits<long double>::digits == 64,
              "verify: the interval arithmetic needs a long double of 64 digits, as x86 has");

namespace maxwrench {

/// This is added to every outward step. It exceeds the smallest normal number, so that intervals
/// about zero do not become denormal, which is slow on many processors.
inline constexpr double kTiny = 1e-280;

/// All real numbers from `low` to `high`, both finite. Every operation returns an interval that
/// contains the result for all members of its operands. It rounds to nearest and then steps
/// outward. For a rounded result x, the next number above is at most x + ulp(x), and ulp(x) <= |x|
/// epsilon + min. Therefore x + (|x| epsilon + min), rounded in turn, is at least that number,
/// which is at least the exact result. kTiny replaces min. The rounding mode is not changed, and no
/// compiler flags are needed except that none may violate IEEE 754.
template <class T>
struct Interval {
  T low = 0, high = 0;

  Interval() = default;
  Interval(T x) : low(x), high(x) {}  // NOLINT: a number is an interval
  Interval(T from, T to) : low(from), high(to) {}

  static T above(T x) { return x + (std::abs(x) * std::numeric_limits<T>::epsilon() + T(kTiny)); }
  static T below(T x) { return x - (std::abs(x) * std::numeric_limits<T>::epsilon() + T(kTiny)); }

  bool is_zero() const { return low == 0 && high == 0; }
  T magnitude() const { return std::max(std::abs(low), std::abs(high)); }
  Interval operator-() const { return {-high, -low}; }

  friend Interval operator+(const Interval& a, const Interval& b) {
    return {below(a.low + b.low), above(a.high + b.high)};
  }
  friend Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const T p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return {below(std::min(std::min(p, q), std::min(r, s))),
            above(std::max(std::max(p, q), std::max(r, s)))};
  }
  friend Interval operator*(T x, const Interval& a) {
    return {below(x * (x < 0 ? a.high : a.low)), above(x * (x < 0 ? a.low : a.high))};
  }
  /// Needs b > 0.
  friend Interval operator/(const Interval& a, const Interval& b) {
    return a * Interval(below(1 / b.high), above(1 / b.low));
  }
  Interval& operator+=(const Interval& other) { return *this = *this + other; }
  Interval& operator-=(const Interval& other) { return *this = *this - other; }
};

/// An upper bound of the square root, which std::sqrt rounds correctly.
template <class T>
T root_above(T x) {
  return Interval<T>::above(std::sqrt(std::max(x, T(0))));
}

using Narrow = Interval<double>;
/// For the computation of constants, so that they are accurate to the last digits of a double.
using Wide = Interval<long double>;

/// An interval of doubles that contains x.
inline Narrow narrow(const Wide& x) {
  if (x.is_zero()) return 0.0;
  return {Narrow::below(static_cast<double>(x.low)), Narrow::above(static_cast<double>(x.high))};
}
inline Wide wide(const Narrow& x) { return {x.low, x.high}; }

template <class T>
struct CosSin {
  Interval<T> c, s;
};

/// Encloses cos x and sin x. x is halved until |x| <= 1/2. There the series is summed up to the
/// term of degree 20, whose magnitude bounds the remainder. Then the angle is doubled again: cos 2y
/// = 1 - 2 sin^2 y and sin 2y = 2 sin y cos y.
inline CosSin<long double> enclose_wide(double x) {
  int halvings = 0;
  long double y = x;  // halving is exact
  for (; std::abs(y) > 0.5L; ++halvings) y /= 2;
  CosSin<long double> sum{1.0L, Wide(y)};
  Wide term(y);
  for (int degree = 2; degree <= 20; ++degree) {
    term = term * Wide(y) / Wide(static_cast<long double>(degree));
    const bool minus = degree % 4 == 2 || degree % 4 == 3;
    Wide& to = degree % 2 == 0 ? sum.c : sum.s;
    to = minus ? to - term : to + term;
  }
  const long double left = term.magnitude();  // the next terms, |y|^21/21! and less, are smaller
  sum.c += Wide(-left, left);
  sum.s += Wide(-left, left);
  for (; halvings > 0; --halvings) {
    sum = {Wide(1.0L) - Wide(2.0L) * (sum.s * sum.s), Wide(2.0L) * (sum.s * sum.c)};
  }
  return sum;
}

}  // namespace maxwrench
