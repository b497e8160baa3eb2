#pragma once

#include <span>
#include <string>

#include "benchmarks/comparison.h"

namespace maxwrench {

/// One panel for each comparison, as SVG: how far the best value so far stays below the best known
/// one against the evaluations, both logarithmic, the median over the seeds for each search.
std::string draw_convergence(std::span<const Comparison> comparisons);

}  // namespace maxwrench
