#pragma once

#include "solvers/search/probe.h"

namespace maxwrench {

/// A local solve of multistart, the bilevel method: Ipopt with a limited-memory Hessian in theta_r
/// only, from theta_r, with values and exact gradients of the objective. At most 40 iterations,
/// under Ipopt's lock. The probe stores the best point.
void optimise_by_ipopt(Probe& probe, const Box& box, const Eigen::VectorXd& theta_r);

}  // namespace maxwrench
