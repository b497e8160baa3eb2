#pragma once

#include "solvers/certify/good_postures.h"

namespace maxwrench {

/// Groups the boxes of a list into clusters, and finds the best posture of each. `best` is the best
/// known posture of all.
void find_clusters(Objective& objective, const Candidate& best, const GoodOptions& options,
                   GoodPostures& result);

}  // namespace maxwrench
