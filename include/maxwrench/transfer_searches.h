#pragma once

#include <span>

#include "maxwrench/strategies.h"

/// @file
/// The table of searches that support transfers only.

namespace maxwrench {

/// Returns the table of searches for transfers.
///
/// They reject all other tasks with std::invalid_argument. It is empty in a build without SUNDIALS.
std::span<const SearchEntry> transfer_searches();

}  // namespace maxwrench
