#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// Expects of `places` random theta_r that every posture that Newton's method finds from `starts`
/// random starts there is in the list of IK solutions, and that it found more than `least_found` in
/// all.
void expect_complete(const Problem& problem, int places, int starts, int least_found);

}  // namespace maxwrench
