#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The facet of a row of a `FacetProgram`, whose force is sign n_pair'(tau_d + J'W w).
struct FacetSide {
  Eigen::Index pair = 0;  ///< the pair of facets
  double sign = 1;        ///< 1, or -1 where a list has a row for each side
  /// Of a list of scenarios, the indices in `ScenarioList::limits` of the limits that bound the
  /// row.
  std::vector<int> limits;
};

}  // namespace maxwrench
