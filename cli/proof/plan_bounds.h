#pragma once

#include "maxwrench/plan_bound.h"

namespace maxwrench {

/// Bounds all trajectories of a task, with its progress on stderr, and prints the bound and its gap
/// to the best trajectory as text or as one JSON object; returns the exit status.
///
/// @param knots  a trajectory in place of a search; empty: none
int bound_trajectories(const Problem& problem, Options options, ProofOptions how,
                       const Eigen::MatrixXd& knots, bool json);

}  // namespace maxwrench
