#pragma once

#include <memory>
#include <span>

#include "maxwrench/search.h"

namespace maxwrench {

struct SearchEntry;

/// Searches one after the other, each from where the earlier ones have been: of their points the
/// best ones that are apart. All but the last get a share of the budget that is left: the share
/// that their entry says, else an equal part; what they leave goes on. History, evaluations and
/// calls join in order. The entries outlive the search; all but the first go on from starts.
std::unique_ptr<Search> make_composition(std::span<const SearchEntry* const> stages);

}  // namespace maxwrench
