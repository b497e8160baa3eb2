#pragma once

#include <vector>

#include "lib/math/decompositions.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// Why there is no posture.
inline constexpr const char* kUnreachableReason =
    "unreachable pose: the dependent joints do not get there";
inline constexpr const char* kSingularReason = "singular: the dependent joints do not fix the pose";

/// What follows from theta_r where the base pose alone does not. Of the coordinates
/// z = [x, y, z, yaw; all joints], theta_r holds r and y, the free base coordinates and the
/// dependent joints, d <= 6. y solves
///
///     X_base(y) X_e(theta_r, y) = X     (pose of the end effector in the world, six equations)
///
/// (where coordinates of X are free, that of theta_r_default). At theta_r_default it is found by
/// Newton's method, damped, from the guess. From there it is carried along the straight line to
/// theta_r: a step along the tangent, then Newton, which must contract at once, else the step is
/// halved. So y is a function of theta_r alone, and it stays on the IK solution of the guess (elbow
/// up or down). By the implicit function theorem, with J_d and J_r the columns of J for y and
/// theta_r,
///
///     dy/dtheta_r = -J_d^+ J_r,     J_d 6×d, J_r 6×r.
///
/// With d < 6 the end effector moves in d ways only; a pose that it reaches satisfies all six
/// equations.
///
/// Along a motion y goes on from one (theta_r, X) to the next in the same way: theta_r along the
/// straight line, the end effector's origin along one too, while it turns about one axis, by less
/// than pi.
class DependentJoints {
 public:
  /// Keeps a reference to the problem.
  explicit DependentJoints(const Problem& problem);
  explicit DependentJoints(const Problem&& problem) = delete;

  /// How far Newton's method stayed from the pose at theta_r_default: |[m; rad]|, about 1e-16 if it
  /// arrived.
  double start_error() const { return start_error_.norm(); }
  /// [m; rad], the twist in world axes that leads from there to the pose.
  const Vector6d& start_gap() const { return start_error_; }
  bool has_start() const;
  /// Whether J_d is singular there: theta_r holds the wrong joints.
  bool start_is_singular() const { return start_is_singular_; }

  /// Solves for y at the problem's pose; null, or why there is none. `theta_r`: its joints.
  /// Dependent joints are turned into their limits by whole turns. Allocates nothing after the
  /// first call.
  const char* follow(const Eigen::VectorXd& theta_r);
  /// The same from where the last call ended, at a pose; the joints are not turned.
  const char* go_on(const Eigen::VectorXd& theta_r, const Pose<double>& pose);

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
  void predict(double from, double to, const Eigen::VectorXd& theta_r);
  const char* carry(const Eigen::VectorXd& theta_r, const Pose<double>& pose);
  const char* arrive();
  void read_theta_r();

  const Problem& problem_;
  Kinematics<double> kinematics_;
  std::vector<int> y_, columns_;  ///< indices of y in z, and in the velocities
  Vector6d start_error_ = Vector6d::Zero();
  bool start_is_singular_ = true;
  Eigen::VectorXd q_, start_z_, theta_r_, from_, z_, trial_;
  Pose<double> pose_;  ///< X
  Vector6d twist_;     ///< [m; rad], the way of X
  Vector6N drift_;     ///< dy by it, J_d^+ twist, where J_ and qr_ are
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
