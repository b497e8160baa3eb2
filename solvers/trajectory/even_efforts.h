#pragma once

#include <vector>

#include "maxwrench/zonotope.h"

namespace maxwrench {

/// Of all efforts that exert a given tau, those that use the most loaded actuator least:
///
///     min g   subject to   B u = tau,   |u_j - middle_j| <= g half_j
///
/// over the actuators that the null space of B moves. They depend continuously on tau, so a motion
/// without jumps has efforts without jumps; and they are within their limits if any are.
///
/// u = B^+ tau + Z v; an optimum is a basis of q + 1 signed rows (Z has q columns), dual feasible
/// whatever tau is: the one of the last call is tried first, and a row that is violated replaces
/// another one until none is.
class EvenEfforts {
 public:
  /// False if the zonotope is not for this: a moved actuator without room, B without full row
  /// rank, too many ways to move.
  bool prepare(const Zonotope& set);
  /// False if it does not end. Allocates nothing.
  bool solve(const Eigen::VectorXd& tau, Eigen::Ref<Eigen::VectorXd> u);

 private:
  static constexpr int kMostMoves = 12;  ///< q
  using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                    kMostMoves + 1, kMostMoves + 1>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostMoves + 1, 1>;

  bool first_basis();
  bool exchange(int entering, double sign);
  bool factor();

  const Zonotope* set_ = nullptr;
  Eigen::MatrixXd Z_;       ///< m×q
  std::vector<int> moved_;  ///< actuators with a row in Z
  Eigen::MatrixXd zeta_;    ///< their rows, in halves of their range
  Eigen::VectorXd alpha_;   ///< (B^+ tau - middle) of them, in the same
  std::vector<int> basis_;  ///< q + 1 of them
  SmallVector sign_;        ///< on which side
  SmallMatrix rows_, inverse_;
  SmallVector point_, right_, weight_, change_;  ///< (v, g), y
};

}  // namespace maxwrench
