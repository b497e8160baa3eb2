#pragma once

#include "maxwrench/capability.h"

/// @file
/// The interface of solvers of wrench programs.

namespace maxwrench {

struct WrenchProgram;

/// Solves wrench programs.
///
/// It keeps the last basis as a warm start. Use one object per thread. To add a solver, override
/// `solve_well_formed`.
class WrenchSolver {
 public:
  virtual ~WrenchSolver() = default;
  /// Solves a program.
  ///
  /// The status is kInfeasible only with a proof in lambda that `proves_infeasible` accepts;
  /// without such a proof it is kNumericalError. It is also kNumericalError if the program is not
  /// `well_formed`.
  ///
  /// @param program     the program
  /// @param efforts     whether to compute u, which a search does not need
  /// @param capability  receives status, reason, beta, w and lambda, and u if `efforts` is set
  void solve(const WrenchProgram& program, bool efforts, Capability& capability);
  /// Solves a program that is well formed, which `solve` checks. The arguments are those of
  /// `solve`. beta may overflow.
  virtual void solve_well_formed(const WrenchProgram& program, bool efforts,
                                 Capability& capability) = 0;
};

}  // namespace maxwrench
