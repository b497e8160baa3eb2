#pragma once

#include "maxwrench/linear_program.h"

/// @file
/// The interface of solvers of linear programs.

namespace maxwrench {

/// Solves linear programs.
///
/// Use one object per thread. A solution that is passed again is a warm start.
class LpSolver {
 public:
  virtual ~LpSolver() = default;
  /// Solves a linear program.
  ///
  /// A failure is a status with a reason, not an exception.
  ///
  /// @param program   the program
  /// @param solution  on entry, the warm start, if its basis is not empty; on return, the result
  virtual void solve(const LinearProgram& program, LpSolution& solution) = 0;
};

}  // namespace maxwrench
