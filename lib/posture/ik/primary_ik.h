#pragma once

#include "lib/math/decompositions.h"
#include "lib/posture/ik/ik_solver.h"

namespace maxwrench {

struct Problem;

/// The dependent joints of the first arm, and the base: every posture that reaches the pose, and
/// the derivative of f(theta_r) through the dependent coordinates.
class PrimaryIk {
 public:
  /// Keeps a reference to the problem and uses its `start_system` if that is valid for the problem.
  explicit PrimaryIk(const Problem& problem);
  explicit PrimaryIk(const Problem&& problem) = delete;

  /// Finds all postures at theta_r and returns their number. Regrasp coordinates have no effect.
  int solve(const Eigen::VectorXd& theta_r);
  /// Whether these are all postures (`IkSolver::complete`).
  bool complete() const { return ik_solutions_.complete(); }
  /// Writes posture i into z = [x, y, z, yaw of the base; all joints], after moving the dependent
  /// joints into their limits by whole turns. Returns whether they are within these limits.
  bool place(int i);
  /// Writes theta_r, and the guess for the dependent coordinates, into z.
  void place_guess();
  const Eigen::VectorXd& z() const { return z_; }

  /// Whether J_d, 6×d, the columns of J for the dependent coordinates, is singular.
  bool is_singular(const Matrix6Xd& J);
  /// The derivatives by theta_r at constant pose, from the derivatives by all joints with the base
  /// in closed form:
  ///
  ///     gradient_k = q_gradient_k - J_r,k' lambda,   J_d' lambda = [0; q_gradient of y].
  void follow(const Matrix6Xd& J, const Eigen::VectorXd& q_gradient, Eigen::VectorXd& gradient);

  /// lambda: the contribution of y to the derivative by the twist of the end effector, at constant
  /// joints of theta_r.
  const Vector6d& by_twist() const { return lambda_; }

 private:
  void decompose(const Matrix6Xd& J);

  const Problem& problem_;
  IkSolver ik_solutions_;
  std::vector<int> columns_;  ///< of J_d in J
  Eigen::VectorXd own_, z_;   ///< own_: theta_r without regrasp coordinates
  Matrix6N J_d_;
  LeastSquares6 qr_;
  Vector6N seed_;
  Vector6d lambda_ = Vector6d::Zero();
};

}  // namespace maxwrench
