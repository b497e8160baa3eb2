#pragma once

#include "maxwrench/capability.h"

namespace maxwrench {

struct WrenchProgram;

/// Solves wrench programs. Fills status, reason, beta, w and lambda of the capability; u only if
/// `efforts` is set (a search does not need it). Infeasible is a verdict only with a proof in
/// lambda that `proves_infeasible` accepts, else the status is kNumericalError. Not shared between
/// threads; keeps the last basis as a warm start.
class WrenchSolver {
 public:
  virtual ~WrenchSolver() = default;
  /// Of a program that is not `well_formed` the status is kNumericalError, from any solver.
  void solve(const WrenchProgram& program, bool efforts, Capability& capability);

 private:
  virtual void solve_well_formed(const WrenchProgram& program, bool efforts,
                                 Capability& capability) = 0;
};

}  // namespace maxwrench
