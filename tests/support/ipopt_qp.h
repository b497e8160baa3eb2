#pragma once

#include <Eigen/Dense>

namespace maxwrench {

/// min x'H x/2 - f'x  subject to  A x = b,  lower <= x <= upper, H symmetric.
struct QuadraticProgram {
  Eigen::MatrixXd H, A;
  Eigen::VectorXd f, b, lower, upper;
};

/// Solves by Ipopt, as an independent method; throws std::runtime_error unless it succeeds.
Eigen::VectorXd solve_by_ipopt(const QuadraticProgram& program);

}  // namespace maxwrench
