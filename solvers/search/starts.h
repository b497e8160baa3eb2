#pragma once

#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

/// Evaluates postures that may be good. Returns those that have a value and are apart, best first,
/// and takes what they cost from the budget, of which at least one evaluation remains.
std::vector<Candidate> starts_among(const std::vector<Eigen::VectorXd>& near, Objective& objective,
                                    long& budget);

/// Replaces the best point of a search that may have ignored its starts by the best of them, if
/// that is better.
void include_starts(const std::vector<Candidate>& starts, SearchResult& result);

}  // namespace maxwrench
