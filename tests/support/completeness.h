#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// Checks the list of IK solutions at `places` random theta_r: it must contain every posture that
/// Newton's method finds from `starts` random starts. Newton's method must find more than
/// `least_found` postures in all.
void expect_complete(const Problem& problem, int places, int starts, int least_found);

}  // namespace maxwrench
