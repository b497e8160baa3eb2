#pragma once

#include "lib/math/random.h"
#include "maxwrench/linear_program.h"

// Functions that the tests of the LP solvers share.

namespace maxwrench {

/// Solves by the simplex method from a cold start, and by GLPK; both verdicts are verified.
LpSolution solve_with_simplex(const LinearProgram& program);
LpSolution solve_with_glpk(const LinearProgram& program);

/// Expects that the program's data confirm the answer.
void expect_verified(const LinearProgram& program, const LpSolution& solution);

/// max x + 2 y  subject to  x + y + s = 4, 0 <= x <= 3, 0 <= y <= 2, s >= 0. Solution: y = 2, x =
/// 2, value 6. More b increases x, so lambda = 1.
LinearProgram small_program();

/// Small integers, so that ties, dependent rows and degenerate vertices are frequent.
LinearProgram random_program(Random& random, int m, int n, bool bounded);

}  // namespace maxwrench
