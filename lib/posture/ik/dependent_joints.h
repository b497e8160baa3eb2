#pragma once

#include <vector>

#include "lib/math/decompositions.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The reasons why there is no posture.
inline constexpr const char* kUnreachableReason =
    "unreachable pose: the dependent joints do not reach it";
inline constexpr const char* kSingularReason = "singular: the dependent joints do not fix the pose";

/// The dependent coordinates of a problem with dependent joints. z = [x, y, z, yaw; all joints] are
/// all coordinates. theta_r has r of them. y has the free base coordinates and the dependent
/// joints, d <= 6 in number. y solves
///
///     X_base(y) X_e(theta_r, y) = X     (pose of the end effector in the world, six equations)
///
/// (where coordinates of X are free, they have their values in theta_r_default). At theta_r_default
/// a damped Newton's method finds y from the guess. From there y is tracked along the straight line
/// to theta_r: a step along the tangent, then Newton's method, which must contract at once;
/// otherwise the step is halved. So y is a function of theta_r alone and stays on the IK solution
/// of the guess (elbow up or down). By the implicit function theorem, with J_d and J_r the columns
/// of J for y and theta_r,
///
///     dy/dtheta_r = -J_d^+ J_r,     J_d 6×d, J_r 6×r.
///
/// If d < 6, the end effector has only d degrees of freedom; a pose that it reaches satisfies all
/// six equations.
///
/// Along a motion y continues from one (theta_r, X) to the next in the same way. theta_r and the
/// end effector's origin move along straight lines, and the end effector turns about one axis by
/// less than pi.
class DependentJoints {
 public:
  /// Keeps a reference to the problem.
  explicit DependentJoints(const Problem& problem);
  explicit DependentJoints(const Problem&& problem) = delete;

  /// The distance |[m; rad]| at which Newton's method ended from the pose at theta_r_default; about
  /// 1e-16 if it converged.
  double start_error() const { return start_error_.norm(); }
  /// [m; rad], the twist in world axes from the point where Newton's method ended to the pose.
  const Vector6d& start_gap() const { return start_error_; }
  bool has_start() const;
  /// Whether J_d is singular at this point, which means that theta_r holds the wrong joints.
  bool start_is_singular() const { return start_is_singular_; }

  /// Solves for y at the problem's pose. Returns null, or the reason why there is no solution.
  /// `theta_r`: its joints. Dependent joints are moved into their limits by whole turns. Allocates
  /// nothing after the first call.
  const char* follow(const Eigen::VectorXd& theta_r);
  /// The same for a pose, from the end of the last call. The joints are not moved by whole turns.
  const char* go_on(const Eigen::VectorXd& theta_r, const Pose<double>& pose);

  /// z at the last theta_r, or at the last point before it that was reached.
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
  Pose<double> pose_;  ///< X, the pose of the end effector
  Vector6d twist_;     ///< [m; rad], the motion of X along the path
  Vector6N drift_;     ///< dy due to this motion, J_d^+ twist, at the point of J_ and qr_
  Eigen::MatrixXd start_slopes_, slopes_;
  bool followed_ = false;  ///< theta_r_ and reason_ are known
  const char* reason_ = nullptr;

  // At the point of the last `linearise`.
  Vector6d error_;  ///< [m; rad], the twist from this point to the pose
  Matrix6Xd J_;
  Matrix6N J_d_;
  LeastSquares6 qr_;
};

}  // namespace maxwrench
