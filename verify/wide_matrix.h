#pragma once

#include <vector>

#include "maxwrench/types.h"
#include "verify/interval.h"

namespace maxwrench {

/// Rows of intervals.
using WideRows = std::vector<std::vector<Wide>>;

WideRows to_wide(const Eigen::MatrixXd& M);
WideRows transposed(const WideRows& M);
WideRows operator*(const WideRows& a, const WideRows& b);

/// Contains the inverse of every matrix in M, symmetric and positive definite. Throws
/// std::invalid_argument if it is too near to a singular one.
WideRows enclose_inverse(const WideRows& M);

/// Contains B^+ = B'(B B')^-1.
WideRows enclose_pseudoinverse(const Eigen::MatrixXd& B);

}  // namespace maxwrench
