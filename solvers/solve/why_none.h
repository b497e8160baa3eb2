#pragma once

#include <string>

#include "maxwrench/solve.h"

namespace maxwrench {

struct Method;

/// Why a search may have found nothing: evaluates the default posture and random values of theta_r
/// (of a task in time: the default throughout, and no reason for a transfer), and returns the most
/// frequent reason among those without a value. The text names joints without effort if no efforts
/// balance those postures. The reason of a measure that is no program, such as the user's, comes
/// before those of postures that are not valid, with the first theta_r at which it holds. Empty if
/// all of them have a value.
std::string why_none(const Problem& task, const Method& method);

}  // namespace maxwrench
