#pragma once

#include <functional>
#include <vector>

#include "lib/math/random.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// What the first stage has seen.
struct Sample {
  std::vector<Eigen::VectorXd> starts;  ///< in the unit cube, best first, each with a value and at
                                        ///< least a twentieth of the bounds from all better ones
  double scale = 1;                     ///< the largest absolute value
};

/// One climb: what a method does with its share of the budget. `random` is its own stream.
using Climb = std::function<void(Probe& probe, const Box& box, const Sample& sample, long part,
                                 Random random)>;

/// A search in three stages. A tenth of the budget samples the bounds uniformly, `start` first.
/// Half of it goes to `parts` climbs side by side. The rest refines the best points that these have
/// found, see `refine`; it gets more if the climbs end early.
SearchResult search_in_stages(Objective& objective, const SearchOptions& options, long parts,
                              const Climb& climb);

/// One climb for each 10,000 evaluations of the budget, 1 to 8.
long parts_of(long budget);

}  // namespace maxwrench
