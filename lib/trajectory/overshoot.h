#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// Instants per interval at which the overshoot of efforts is computed.
inline constexpr int kOvershootInstants = 100;

/// By which share the limits of all efforts would have to grow for efforts that move a mass [kg] on
/// the spline through all knots Q of a transfer (K×r): the largest |effort| / limit - 1 of the
/// efforts that use the least share of their limits, in any scenario. Negative: all limits hold.
/// NaN where the facets of {B u} are not known.
double overshoot_of(const Problem& problem, const Eigen::MatrixXd& Q, double mass);

/// How far the joints of theta_r exceed their limits on the clamped cubic spline through all knots
/// Q (K×r) of a motion in time T. Exact: from the extremes of the cubics. Negative: the limits
/// hold.
struct JointOvershoot {
  double speed = 0;  ///< the largest |rate| / limit - 1 [-]
  double place = 0;  ///< the largest distance beyond a limit [rad or m]
};
JointOvershoot joint_overshoot_of(const Problem& problem, const Eigen::MatrixXd& Q, double T);

}  // namespace maxwrench
