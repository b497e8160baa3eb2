#pragma once

#include "solvers/search/facet_starts.h"

namespace maxwrench {

/// A local solve by Ipopt with a limited-memory Hessian, at most 100 iterations, under Ipopt's
/// lock. At a point without a posture, Ipopt gets a failure code and shortens its step.
FacetEnd solve_facets_by_ipopt(FacetView& view);

}  // namespace maxwrench
