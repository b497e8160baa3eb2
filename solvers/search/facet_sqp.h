#pragma once

#include "solvers/search/facet_starts.h"

namespace maxwrench {

/// A local solve by SLSQP of NLopt, at most 400 points. SLSQP wants numbers everywhere: a point
/// without a posture misses all rows by ten half widths there, so that a step gets shorter.
FacetEnd solve_facets_by_slsqp(FacetView& view);

}  // namespace maxwrench
