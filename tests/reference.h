#pragma once

#include <optional>

#include "lib/wrench_program.h"

namespace maxwrench {

/// The optimum by enumeration of all bases: n columns of [B, -J'W] are basic, free w always, the
/// other u at one of their limits. Slow and independent of every solver. Nothing if no basis is
/// feasible.
std::optional<double> brute_force(const WrenchProgram& program);

}  // namespace maxwrench
