#pragma once

#include <functional>

#include "maxwrench/linear_program.h"

namespace maxwrench {

/// max -1's  subject to  A x + s_1 - s_2 = b, s >= 0: feasible whenever the bounds do not cross,
/// and its optimum is minus the least 1-norm of A x - b.
LinearProgram elastic(const LinearProgram& program);

/// max c'r  subject to  A r = 0, with each r_j in [-1, 1], cut off at zero where x_j has a finite
/// bound on that side: its optimum is positive exactly if the objective has an improving ray.
LinearProgram recession(const LinearProgram& program);

/// Solves a program that has an optimum; fills x, lambda and iterations, or returns false.
using LpRun = std::function<bool(const LinearProgram&, LpSolution&)>;

/// One run of a library, warm from the solution's basis or cold, with its fast or its careful
/// settings. Returns false if it ended without a verdict that the data confirm.
using LpAttempt = std::function<bool(const LinearProgram&, bool warm, bool careful, LpSolution&)>;

/// Runs the fast settings, then the careful ones (counted as a cold restart if the first run was
/// warm), then `prove_no_optimum`.
void solve_by_attempts(const LinearProgram& program, const LpAttempt& attempt,
                       LpSolution& solution);

/// For a library that found no optimum and provides no proof. Solves the elastic program, whose
/// multipliers are the Farkas vector. If that proves nothing, solves the recession program, whose
/// solution is the ray. A proof that the data do not confirm becomes kNumericalError.
void prove_no_optimum(const LinearProgram& program, const LpRun& run, LpSolution& solution);

/// Whether the program must not be passed to a library: malformed data or entries beyond 1e20
/// (kNumericalError), or crossing bounds (kInfeasible). Then fills `solution`.
bool rejected(const LinearProgram& program, LpSolution& solution);

/// Stores a verdict without optimum and its reason; there is no certificate yet.
void give_up(LpSolution& solution, Status status, const char* reason);

}  // namespace maxwrench
