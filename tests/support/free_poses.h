#pragma once

#include "maxwrench/problem.h"

namespace maxwrench {

/// The same task with these axes of its pose free, each within +-0.3 m or rad.
Problem with_free_pose(Problem problem, const FreePose& free);

}  // namespace maxwrench
