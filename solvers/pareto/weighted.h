#pragma once

#include <memory>
#include <vector>

#include "maxwrench/objective.h"

namespace maxwrench {

/// min_k f_k(theta_r) / w_k over the objectives f_k with w_k > 0; it has no value where one of
/// these has none. The bounds are those of the first objective. The gradient is that of the least,
/// the first of equal ones.
std::unique_ptr<Objective> make_weighted_objective(
    const std::vector<std::unique_ptr<Objective>>& objectives, const Eigen::VectorXd& weights);

}  // namespace maxwrench
