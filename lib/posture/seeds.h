#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include "maxwrench/types.h"

namespace maxwrench {

/// Throws std::invalid_argument for derivatives by q, J_2 or C_2 of a wrong size; a measure that
/// does not depend on them leaves them empty.
inline void require_columns(const char* by, Eigen::Index got, Eigen::Index columns) {
  if (got == 0 || got == columns) return;
  throw std::invalid_argument("derivatives: got " + std::to_string(got) + " columns by " + by +
                              ", expected " + std::to_string(columns) + ", or none");
}

/// The derivatives of a value by tau_d, J, q, J_2 and C_2.
struct Seeds {
  const Eigen::VectorXd& tau_d;
  const Matrix6Xd& J;
  const Eigen::VectorXd& q;
  const Matrix6Xd &J_2, &C_2;

  /// Throws std::invalid_argument unless a measure has filled its derivatives by n velocities.
  void require(Eigen::Index n, Eigen::Index joints) const {
    if (tau_d.size() != n || J.cols() != n) {
      throw std::invalid_argument("derivatives: got " + std::to_string(tau_d.size()) +
                                  " by tau_d and " + std::to_string(J.cols()) +
                                  " columns by J, expected " + std::to_string(n) + " of both");
    }
    require_columns("q", q.size(), joints);
  }
};

}  // namespace maxwrench
