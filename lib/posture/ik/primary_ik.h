#pragma once

#include "lib/math/decompositions.h"
#include "lib/posture/ik/ik_solver.h"

namespace maxwrench {

struct Problem;

/// The joints of the first arm, and the base, that follow from theta_r: every posture that reaches
/// the pose, and how f(theta_r) changes through what follows.
class PrimaryIk {
 public:
  /// Keeps a reference to the problem, whose `start_system` it takes if it serves.
  explicit PrimaryIk(const Problem& problem);
  explicit PrimaryIk(const Problem&& problem) = delete;

  /// All postures at theta_r, of which regrasp coordinates do not count; returns their number.
  int solve(const Eigen::VectorXd& theta_r);
  /// Whether that are all of them (`IkSolver::complete`).
  bool complete() const { return ik_solutions_.complete(); }
  /// Writes posture i into z = [x, y, z, yaw of the base; all joints]; whether the dependent joints
  /// are within their limits, into which they are turned by whole turns.
  bool place(int i);
  /// Writes theta_r and the guess of all else.
  void place_guess();
  const Eigen::VectorXd& z() const { return z_; }

  /// Whether J_d, 6×d of J's columns for what follows, is singular.
  bool is_singular(const Matrix6Xd& J);
  /// From the derivatives by all joints, with the base in closed form behind them, those by theta_r
  /// at the pose:
  ///
  ///     gradient_k = q_gradient_k - J_r,k' lambda,   J_d' lambda = [0; q_gradient of y].
  void follow(const Matrix6Xd& J, const Eigen::VectorXd& q_gradient, Eigen::VectorXd& gradient);

  /// By the twist of the end effector, at joints of theta_r that rest: what y adds to it, lambda.
  const Vector6d& by_twist() const { return lambda_; }

 private:
  void decompose(const Matrix6Xd& J);

  const Problem& problem_;
  IkSolver ik_solutions_;
  std::vector<int> columns_;  ///< of J_d in J
  Eigen::VectorXd own_, z_;   ///< theta_r without regrasp coordinates
  Matrix6N J_d_;
  LeastSquares6 qr_;
  Vector6N seed_;
  Vector6d lambda_ = Vector6d::Zero();
};

}  // namespace maxwrench
