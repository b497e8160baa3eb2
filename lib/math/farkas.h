#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace maxwrench {

/// A bound of at least this magnitude counts as infinite.
inline constexpr double kInfiniteBound = 1e20;
/// A sum below this share of its terms' magnitudes may be rounding alone.
inline constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

/// A sum, the sum of its terms' magnitudes and the largest of these magnitudes.
struct TermSum {
  double value = 0;
  double magnitudes = 0;
  double largest = 0;
  void add(double term) {
    const double magnitude = std::abs(term);
    value += term;
    magnitudes += magnitude;
    largest = std::max(largest, magnitude);
  }
};

/// Checks whether y proves that no x satisfies A x = b, l <= x <= u (Farkas): y'b exceeds the
/// supremum of y'A x over the bounds. The caller adds the terms of y'b, then (A'y)_j and the bounds
/// of each column j.
///
/// Rounding may change (A'y)_j; this error times the larger absolute bound counts against the
/// proof. Where the bound is infinite, (A'y)_j counts as zero if it is below 1e-10 of the sum of
/// its terms' magnitudes. The margin must exceed 1e-10 of the sum of all magnitudes. NaN proves
/// nothing.
class Farkas {
 public:
  void add_row(double term) { margin_.add(term); }

  void add_column(const TermSum& slope, double low, double high) {
    const bool finite_low = low > -kInfiniteBound, finite_high = high < kInfiniteBound;
    const double off = kRounding * slope.magnitudes;
    const double reach = std::max(finite_low ? std::abs(low) : 0, finite_high ? std::abs(high) : 0);
    if (off * reach > 0) margin_.add(-off * reach);
    if (slope.value == 0) return;
    if (slope.value > 0 ? finite_high : finite_low) {
      margin_.add(-slope.value * (slope.value > 0 ? high : low));
    } else if (!(std::abs(slope.value) <= kMargin * slope.magnitudes)) {
      open_ = true;
    }
  }

  bool holds() const { return !open_ && margin_.value > kMargin * margin_.magnitudes; }

 private:
  static constexpr double kMargin = 1e-10;

  TermSum margin_;     ///< y'b minus the supremum
  bool open_ = false;  ///< the supremum is infinite
};

}  // namespace maxwrench
