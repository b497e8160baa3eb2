#pragma once

#include "lib/measure.h"
#include "lib/wrench_program.h"

namespace maxwrench {

/// Solves wrench programs. Fills status, reason, beta, w and lambda of the capability; u only if
/// `efforts` is set (a search does not need it). Not shared between threads; keeps the last basis
/// as a warm start.
class WrenchSolver {
 public:
  virtual ~WrenchSolver() = default;
  virtual void solve(const WrenchProgram& program, bool efforts, Capability& capability) = 0;
};

}  // namespace maxwrench
