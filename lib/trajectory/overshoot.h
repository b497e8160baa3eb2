#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// Instants per interval at which the overshoot of a transfer is computed.
inline constexpr int kOvershootInstants = 100;

/// By which share the limits of all efforts would have to grow for efforts that move a mass [kg] on
/// the spline through all knots Q of a transfer (K×r): the largest |effort| / limit - 1 of the
/// efforts that use the least share of their limits. Negative: all limits hold. NaN where the
/// facets of {B u} are not known.
double overshoot_of(const Problem& problem, const Eigen::MatrixXd& Q, double mass);

}  // namespace maxwrench
