#pragma once

#include "lib/math/decompositions.h"
#include "lib/posture/ik/continuation.h"
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
/// to theta_r (`Continuation`). So y is a function of theta_r alone and stays on the IK solution
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
  DependentJoints(const DependentJoints&) = delete;

  /// The distance |[m; rad]| at which Newton's method ended from the pose at theta_r_default; about
  /// 1e-16 if it converged.
  double start_error() const { return start_error_.norm(); }
  /// [m; rad], the twist in world axes from the point where Newton's method ended to the pose.
  const Vector6d& start_gap() const { return start_error_; }
  bool has_start() const { return start_error() <= kArrived; }
  /// Whether J_d is singular at this point, which means that theta_r holds the wrong joints.
  bool start_is_singular() const { return start_is_singular_; }

  /// Solves for y at the problem's pose. Returns null, or the reason why there is no solution.
  /// `theta_r`: its joints. Dependent joints are moved into their limits by whole turns. Allocates
  /// nothing after the first call.
  const char* follow(const Eigen::VectorXd& theta_r);
  /// The same for a pose, from the end of the last call. The joints are not moved by whole turns.
  const char* go_on(const Eigen::VectorXd& theta_r, const Pose<double>& pose);

  /// z at the last theta_r that was reached.
  const Eigen::VectorXd& z() const { return z_; }
  /// dz/dtheta_r, (4 + joints)×r.
  const Eigen::MatrixXd& slopes() const { return slopes_; }

 private:
  const char* carry(const Eigen::VectorXd& theta_r, const Pose<double>& pose);
  bool differentiate(const ToolState<double>& state);
  void write_z();

  const Problem& problem_;
  ToolChain chain_;
  Continuation<double> continuation_;
  HomotopyPath<double> path_;  ///< from the last theta_r and X that were reached
  Vector6d start_error_;
  bool start_is_singular_ = true;
  Six<double> start_y_{}, y_{};
  Eigen::VectorXd theta_r_, z_;
  Eigen::MatrixXd start_slopes_, slopes_;
  LeastSquares6 qr_;
  bool followed_ = false;  ///< theta_r_ and reason_ are known
  const char* reason_ = nullptr;
};

}  // namespace maxwrench
