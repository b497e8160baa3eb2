#pragma once

#include "verify/lp_proof.h"

namespace maxwrench {

/// Programs of more rows than this are rejected.
inline constexpr int kMostExactRows = 500;

/// The verdict of a program in rational numbers, by the simplex method from the basis of
/// `solution`. The pivot is the variable with the lowest index that may move (Bland): exact
/// arithmetic keeps degeneracy that rounding removes in doubles. Without a basis, it starts with
/// all logical variables. kBudgetExhausted after 1,000 pivots. Throws std::invalid_argument beyond
/// `kMostExactRows`.
LpProof exact_proof(const LinearProgram& program, const LpSolution& solution);

}  // namespace maxwrench
