#pragma once

#include <memory>
#include <vector>

#include "maxwrench/solve.h"

namespace maxwrench {

/// `solve` of a static task that begins at postures which may be good.
///
/// Each posture costs an evaluation of the budget. The search begins at those that have a value and
/// are apart from each other, best first. A search that accepts no starts ignores them; the best of
/// them still counts.
///
/// @param near  values of theta_r (r); those without a value are left out
Answer solve_from(std::shared_ptr<const Problem> task, const std::vector<Eigen::VectorXd>& near,
                  const Options& options);

}  // namespace maxwrench
