#pragma once

#include <vector>

#include "maxwrench/zonotope.h"

namespace maxwrench {

/// Of all efforts that exert a given tau, those that load the most loaded actuator least:
///
///     min g   subject to   B u = tau,   |u_j - middle_j| <= g half_j
///
/// over the actuators that the null space of B moves. Actuators whose limits meet, such as dead
/// ones, stay there. They depend continuously on tau, so a motion without jumps has efforts without
/// jumps. They are within their limits if any such efforts are.
///
/// u = B^+ tau + Z v. An optimum is a basis of q + 1 signed rows (Z has q columns), which is dual
/// feasible for any tau. The basis of the last call is tried first, and a violated row replaces
/// another one until none is violated.
class EvenEfforts {
 public:
  /// Returns false if the zonotope is not suitable: a moved actuator without finite limits, B
  /// (without the columns of actuators whose limits meet) without full row rank, or too many
  /// columns of Z.
  bool prepare(const Zonotope& set);
  /// Returns false if it does not terminate. Allocates nothing.
  bool solve(const Eigen::VectorXd& tau, Eigen::Ref<Eigen::VectorXd> u);

 private:
  static constexpr int kMostMoves = 12;  ///< q
  using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                    kMostMoves + 1, kMostMoves + 1>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostMoves + 1, 1>;

  bool split(const Zonotope& set);
  bool first_basis();
  bool exchange(int entering, double sign);
  bool factor();

  const Zonotope* set_ = nullptr;
  Eigen::MatrixXd Z_;             ///< m×q
  Eigen::MatrixXd B_pinv_;        ///< of the actuators with range; zero rows for the others
  Eigen::VectorXd fixed_;         ///< efforts of those without range, else zero
  Eigen::VectorXd tau_0_;         ///< B fixed
  std::vector<int> moved_;        ///< actuators with a row in Z
  Eigen::MatrixXd zeta_;          ///< their rows, divided by half of their range
  Eigen::VectorXd rest_, alpha_;  ///< tau less tau_0; (B^+ of it - middle) of them, scaled likewise
  std::vector<int> basis_;        ///< q + 1 rows
  SmallVector sign_;              ///< side of each row
  SmallMatrix rows_, inverse_;
  SmallVector point_, right_, weight_, change_;  ///< (v, g), y
};

}  // namespace maxwrench
