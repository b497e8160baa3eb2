#pragma once

#include <memory>
#include <span>

#include "maxwrench/search.h"

namespace maxwrench {

struct SearchEntry;

/// Runs searches one after the other. Each continues from the points that the earlier ones found:
/// the best of those that are apart. Each search but the last gets a share of the remaining budget:
/// the share in its entry, or else an equal part. What it does not use passes to the later ones.
/// History, evaluations and calls are joined in order. The entries must outlive the search. All
/// searches but the first must accept starts.
std::unique_ptr<Search> make_composition(std::span<const SearchEntry* const> stages);

}  // namespace maxwrench
