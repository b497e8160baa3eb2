#pragma once

#include "lib/trajectory/scheme.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// Limits of r numbers.
struct NumberRanges {
  Eigen::VectorXd low, high;
};

/// What theta_r, its rate and its acceleration can be at one instant.
struct InstantRanges {
  NumberRanges place;  ///< [rad or m]
  NumberRanges rate;   ///< [1/s]
  NumberRanges bend;   ///< the acceleration [1/s^2]
};

/// The ranges at an instant over all tables of knots that the task accepts: of limits of theta_r
/// and of its rate, and of rows that must vanish, each with the tolerance of tables. `maps` has
/// accelerations.
///
/// The largest a'Q over the knots Q of one coordinate, within l <= Q <= u and s_l <= S Q <= s_u, is
/// a linear program. For any y, it is at most
///
///     sum_j max over [l_j, u_j] of (a - S'y)_j Q_j + sum_i max over [s_l,i, s_u,i] of y_i s_i.
///
/// The y of a solver is used; the sum alone proves the range, so the solver need not be exact.
InstantRanges ranges_at(const Problem& problem, const SchemeMaps& maps, int instant);

}  // namespace maxwrench
