#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/race/comparison.h"
#include "drawing/ecdf.h"

namespace maxwrench {

/// The share of targets that each search reached, against evaluations and against ms, for one
/// problem or for several taken together.
std::vector<EcdfPanel> ecdf_panels(std::span<const Comparison> comparisons,
                                   const std::string& title);

}  // namespace maxwrench
