#pragma once

#include "maxwrench/trajectory_program.h"

namespace maxwrench {

/// Programs with one factor t for all instants, by facets. With a_i = (J'W)_i / c_w,i the factors
/// that all instants permit,
///
///     b_min <= N'(tau_d,i + a_i t) <= b_max   and   w_min,i <= t / c_w,i <= w_max,i   for all i,
///
/// are an interval, of which the upper end is the value. Rates are ignored.
class CommonFactor {
 public:
  /// Whether the program is of this kind: no border, one wrench column, facets, and the same limits
  /// at the first instant.
  static bool suits(const TrajectoryProgram& program);

  /// Sets value, lambda and pi of an optimum, or the proof that there is none. lambda, mu, pi and
  /// nu must be zero and of the right size.
  ///
  /// If the ends of the interval cross by so little that the lower ones are violated by 1e-8 of the
  /// limits at most, the upper end is the value.
  ///
  /// @return kOptimal, kInfeasible, or kUnbounded if nothing limits t from above
  Status solve(const TrajectoryProgram& program, TrajectorySolution& solution);

 private:
  /// An end of the interval: t <= value, or t >= value.
  struct End {
    double value = 0;
    int instant = -1, pair = -1;  ///< the facet pair; -1: a limit of w
    double slope = 0;             ///< n'a of the pair
  };

  void narrow(const TrajectoryProgram& program, int i);
  void add(double low, double high, const End& at);
  static void set_multipliers(const TrajectoryProgram& program, const End& end, double sign,
                              TrajectorySolution& solution);

  End low_, high_;
  End missed_;  ///< a pair that is parallel to a and violated; its slope is the side
  Eigen::VectorXd slopes_, loads_;
  double slack_ = 0;  ///< how far low may exceed high
};

}  // namespace maxwrench
