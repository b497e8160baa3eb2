#pragma once

#include "maxwrench/linear_program.h"

namespace maxwrench {

/// Solves linear programs. Not shared between threads; a solution that is passed again is a warm
/// start.
class LpSolver {
 public:
  virtual ~LpSolver() = default;
  /// Fills `solution`, whose storage is reused. Failure is a status with a reason, not an
  /// exception.
  virtual void solve(const LinearProgram& program, LpSolution& solution) = 0;
};

}  // namespace maxwrench
