#pragma once

#include <string>
#include <vector>

#include "verify/trajectory/jet.h"

namespace maxwrench {

/// The clamped cubic splines through a table of knots, in closed form. Interval i of the table lies
/// between knots i and i + 1, and x in [0, 1] is the place within it.
class KnotCurve {
 public:
  /// @param table     the knots (K×r), K >= 2; of an impulse theta_0 is the first one
  /// @param duration  from the first to the last knot [s]
  KnotCurve(const Eigen::MatrixXd& table, double duration);

  int intervals() const { return intervals_; }
  int coordinates() const { return coordinates_; }
  /// [1/s] dx/dt.
  const Narrow& rate() const { return rate_; }
  /// Encloses y(t) of a coordinate for all x of an interval.
  template <int N>
  Jet<N> at(int coordinate, int interval, const Narrow& x) const;
  /// [rad/s or m/s] A bound of |y'| from x_0 to x_1.
  double fastest(int coordinate, int interval, double x_0, double x_1) const;

  /// A place where a coordinate leaves an interval of numbers, or may do so.
  struct Outside {
    int interval = 0;
    double x = 0, value = 0;
    bool found = false;
  };
  /// Searches for a place at which y, or its rate y', is certainly outside [lower, upper]. The
  /// curve is cut in halves until its control points prove that each part is within the limits
  /// less or plus `tolerance`. A part that cannot be decided counts as outside.
  Outside leaves(int coordinate, bool rate, double lower, double upper, double tolerance) const;

 private:
  using Cubic = std::array<Narrow, 4>;  ///< coefficients of 1, x, x^2, x^3
  const Cubic& cubic(int coordinate, int interval) const {
    return cubics_[static_cast<std::size_t>(coordinate * intervals_ + interval)];
  }

  int intervals_, coordinates_;
  Narrow rate_;
  std::vector<Cubic> cubics_;
};

}  // namespace maxwrench
