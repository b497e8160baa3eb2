#pragma once

#include "maxwrench/solve.h"

namespace maxwrench {

/// A posture of a static task as a task in time with one instant. `gradient` is that of beta by
/// theta_r.
Trajectory one_instant(const Problem& task, const Posture& posture, const Capability& capability,
                       const Eigen::VectorXd& gradient);

}  // namespace maxwrench
