#pragma once

#include "solvers/search/probe.h"

namespace maxwrench {

/// A local solve of multistart, the bilevel method: Ipopt with a limited-memory Hessian in theta_r
/// alone, from theta_r, by values and exact gradients of the objective. At most 40
/// iterations, behind Ipopt's lock; the probe keeps the best point.
void optimise_by_ipopt(Probe& probe, const Box& box, const Eigen::VectorXd& theta_r);

}  // namespace maxwrench
