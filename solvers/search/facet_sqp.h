#pragma once

#include "solvers/search/facet_starts.h"

namespace maxwrench {

/// A local solve by SLSQP of NLopt, at most 400 points. SLSQP needs a number at every point: where
/// there is no posture, all rows appear violated by ten half widths, so that SLSQP shortens its
/// step.
FacetEnd solve_facets_by_slsqp(FacetView& view);

}  // namespace maxwrench
