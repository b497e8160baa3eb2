#pragma once

#include "solvers/search/facet_starts.h"

namespace maxwrench {

/// A local solve by SLSQP of NLopt (`solve_rows_by_slsqp`), at most 400 points.
FacetEnd solve_facets_by_slsqp(FacetView& view);

}  // namespace maxwrench
