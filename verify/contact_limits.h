#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// Limits of the components w of a second contact's wrench C w, as coordinates of a posture: a
/// share omega in [0, 1] stands for
///
///     w = w_min + omega (w_max - w_min) + t (v_min + omega (v_max - v_min)),
///
/// with the value t, at least zero if v is not zero. All are finite. A component without a limit of
/// its own is bounded by the base's free linear axes, which bear the weight, t c and C w alone:
///
///     |w| <= (F + t |c_f|)/sigma,
///
/// with the largest force F of weight and actuators, the force c_f of c, and the smallest singular
/// value sigma of the force of C in these axes.
struct ContactLimits {
  /// Throws std::invalid_argument, in one line, if nothing limits a component.
  explicit ContactLimits(const Problem& problem);

  Eigen::VectorXd w_min, w_max, v_min, v_max;

  bool grow() const { return (v_min.array() != v_max.array()).any(); }
};

}  // namespace maxwrench
