#pragma once

#include <span>

#include "maxwrench/strategies.h"

/// @file
/// The table of searches for tasks along a path.

namespace maxwrench {

/// Returns the table of searches for tasks along a path.
///
/// They are the methods by which others plan such motions, and decide instant by instant. They
/// reject all other tasks with std::invalid_argument.
std::span<const SearchEntry> path_searches();

}  // namespace maxwrench
