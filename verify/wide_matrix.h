#pragma once

#include <vector>

#include "maxwrench/types.h"
#include "verify/interval.h"

namespace maxwrench {

/// A matrix of intervals, row by row.
using WideRows = std::vector<std::vector<Wide>>;

WideRows to_wide(const Eigen::MatrixXd& M);
WideRows transposed(const WideRows& M);
WideRows operator*(const WideRows& a, const WideRows& b);

/// Encloses the inverse of every matrix in M, which must be symmetric and positive definite. Throws
/// std::invalid_argument if M is too close to a singular matrix.
WideRows enclose_inverse(const WideRows& M);

/// Encloses B^+ = B'(B B')^-1.
WideRows enclose_pseudoinverse(const Eigen::MatrixXd& B);

}  // namespace maxwrench
