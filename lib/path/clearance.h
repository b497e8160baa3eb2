#pragma once

#include <vector>

#include "lib/robot/kinematics.h"
#include "maxwrench/plan.h"

namespace maxwrench {

/// The pairs of bodies nearer than `within` [m] at a configuration whose links are given, of those
/// whose distance is known: clearance and its gradient over theta_r, by the velocities of the
/// nearest points along the line between them. Appended with the number of the knot.
void find_near_pairs(const Problem& problem, const Kinematics<double>& kinematics, int knot,
                     double within, std::vector<NearPair>& pairs);

}  // namespace maxwrench
