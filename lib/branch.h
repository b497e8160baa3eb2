#pragma once

#include <vector>

#include "lib/decompositions.h"
#include "lib/kinematics.h"
#include "lib/problem.h"

namespace maxwrench {

/// The joints of the chain from the base to an end effector, from the base outward.
std::vector<int> chain_to(const Robot& robot, int end_effector);

/// In how many independent ways the free base axes and the joints of the chain move an end
/// effector: the largest rank of their columns of J over all postures, 6 in space and 3 in a plane.
/// A pose leaves (free base axes + joints of the chain - this number) coordinates free: theta_r.
int motions_of(const Robot& robot, int end_effector);

/// [x, y, z, yaw] of a base that neither rolls nor pitches -> its pose in the world: the robot's
/// mount, then (x, y, z), then Rz(yaw).
Pose<double> base_pose(const Robot& robot, const Eigen::Vector4d& x);

/// What follows from theta_r where the base pose alone does not. Of the coordinates
/// z = [x, y, z, yaw; all joints], theta_r holds r and y, the free base coordinates and the
/// dependent joints, d <= 6. y solves
///
///     X_base(y) X_e(theta_r, y) = X     (pose of the end effector in the world, six equations)
///
/// At theta_r_default it is found by Newton's method, damped, from the guess. From there it is
/// carried along the straight line to theta_r: a step along the tangent, then Newton, which must
/// contract at once, else the step is halved. So y is a function of theta_r alone, and it stays on
/// the branch of the guess (elbow up or down). By the implicit function theorem, with J_d and J_r
/// the columns of J for y and theta_r,
///
///     dy/dtheta_r = -J_d^+ J_r,     J_d 6×d, J_r 6×r.
///
/// With d < 6 the end effector moves in d ways only; a pose that it reaches satisfies all six
/// equations.
class Branch {
 public:
  /// Keeps a reference to the problem.
  explicit Branch(const Problem& problem);

  /// How far Newton's method stayed from the pose at theta_r_default: |[m; rad]|, about 1e-16 if it
  /// arrived.
  double start_error() const { return start_error_; }
  bool has_start() const;
  /// Whether J_d is singular there: theta_r holds the wrong joints.
  bool start_is_singular() const { return start_is_singular_; }

  /// Solves for y; null, or why there is none. `theta_r`: its joints. Allocates nothing after the
  /// first call.
  const char* follow(const Eigen::VectorXd& theta_r);

  /// Of the last theta_r, or the last point before it that was reached.
  const Eigen::VectorXd& z() const { return z_; }
  /// dz/dtheta_r, (4 + joints)×r.
  const Eigen::MatrixXd& slopes() const { return slopes_; }

 private:
  void linearise(const Eigen::VectorXd& z);
  void differentiate();
  bool approach(double& damping);
  void start();
  bool contract(double tolerance);
  const char* carry(const Eigen::VectorXd& theta_r);

  const Problem& problem_;
  Kinematics<double> kinematics_;
  std::vector<int> y_, columns_;  ///< indices of y in z, and in the velocities
  double start_error_ = 0;
  bool start_is_singular_ = true;
  Eigen::VectorXd q_, start_z_, theta_r_, z_, trial_;
  Eigen::MatrixXd start_slopes_, slopes_;
  bool followed_ = false;  ///< theta_r_ and reason_ are known
  const char* reason_ = nullptr;

  // At the point that `linearise` saw last.
  Vector6d error_;  ///< [m; rad], the twist that leads to the pose
  Matrix6Xd J_;
  Matrix6N J_d_;
  LeastSquares6 qr_;
};

}  // namespace maxwrench
