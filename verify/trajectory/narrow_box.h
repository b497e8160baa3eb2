#pragma once

#include <Eigen/Core>
#include <vector>

#include "verify/trajectory/jet.h"

// Vectors and small matrices of intervals, for Krawczyk's operator.

namespace maxwrench {

using NarrowBox = std::vector<Narrow>;

double middle_of(const Narrow& x);
Eigen::VectorXd middles(const NarrowBox& box);

/// The largest width of a side; zero without sides.
double width_of(const NarrowBox& box);

/// Whether a box lies in the interior of another one. False for NaN.
bool lies_in(const NarrowBox& inner, const NarrowBox& outer);

/// An approximate inverse of the middles of M, given by rows; empty if there is none.
Eigen::MatrixXd inverse_of_middles(const std::vector<NarrowBox>& M);

/// Y x, for numbers Y.
NarrowBox product(const Eigen::MatrixXd& Y, const NarrowBox& x);

/// 1 - Y A.
std::vector<NarrowBox> deviation(const Eigen::MatrixXd& Y, const std::vector<NarrowBox>& A);

/// b + off x.
NarrowBox affine(const NarrowBox& b, const std::vector<NarrowBox>& off, const NarrowBox& x);

/// Encloses the solutions of x = b + off x. Empty if the largest row sum of |off| is not well below
/// one, or if b is not small enough to be multiplied.
NarrowBox solve_near_one(const NarrowBox& b, const std::vector<NarrowBox>& off);

}  // namespace maxwrench
