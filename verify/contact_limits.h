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
///     |w_k| <= (F + t |c_f|)/sigma,
///
/// with the largest force F of weight and actuators, the force c_f of c, and the smallest singular
/// value sigma of the forces C_f of C in these axes. If no component is negative, sigma is also the
/// least d'C_f,k with the direction d of the sum of all C_f,k: then d'C_f w >= sigma w_k. The
/// larger one counts.
struct ContactLimits {
  /// Throws std::invalid_argument, in one line, if nothing limits a component.
  explicit ContactLimits(const Problem& problem);

  Eigen::VectorXd w_min, w_max, v_min, v_max;

  bool grow() const { return (v_min.array() != v_max.array()).any(); }
};

}  // namespace maxwrench
