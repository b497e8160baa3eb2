#pragma once

#include <optional>
#include <vector>

#include "lib/math/decompositions.h"
#include "lib/math/dual.h"
#include "lib/posture/ik/dependent_joints.h"
#include "lib/robot/kinematics.h"
#include "lib/trajectory/carried.h"
#include "maxwrench/path.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The motion of the whole robot from that of theta_r and of the end effector
/// (eq:redundantJacobian, v = J_e x_dot + A_r theta_r_dot), and its derivative. For problems
/// without a second contact. Joints outside the chain from base to end effector rest. A template on
/// the scalar, as Kinematics.
///
/// If theta_r holds all joints of the chain, the motion has a closed form. The joints give the end
/// effector's motion relative to the base, and the rest of the end effector's motion is the base's.
///
/// If joints are dependent (`DependentJoints`), the motion starts from a posture that reaches the
/// pose. With J_d the columns of J for the free base axes and the dependent joints, and J_r those
/// of theta_r,
///
///     J_d v_d = x_dot - J_r theta_r_dot,   J_d v_dot_d = x_ddot - J_dot v - J_r theta_r_ddot,
///
/// d <= 6 numbers, by least squares. The derivatives of a solution y of F(y, p) = 0 are those of
/// one step y - J_d^+ F in dual numbers, where J_d holds values only.
template <class T>
class RobotMotion {
 public:
  /// The problem must outlive this object.
  explicit RobotMotion(const Problem& problem);
  explicit RobotMotion(const Problem&&) = delete;

  /// Sets theta_r and its time derivatives, r numbers each.
  void set(const PathPoint& x, const VectorX<T>& theta_r, const VectorX<T>& rate,
           const VectorX<T>& acceleration);
  /// The same with dependent joints: `base` and all joints q bring the end effector to x at the
  /// values of theta_r.
  void set(const PathPoint& x, const Pose<double>& base, const Eigen::VectorXd& q,
           const VectorX<T>& theta_r, const VectorX<T>& rate, const VectorX<T>& acceleration);

  /// The same for a transfer, in which theta_r holds all joints of the chain and the base rests at
  /// its mount. The end effector's motion follows.
  void set(const VectorX<T>& theta_r, const VectorX<T>& rate, const VectorX<T>& acceleration);

  const VectorX<T>& q() const { return q_; }
  const Pose<T>& base() const { return base_; }
  /// n numbers each: base twist in base axes on the free axes, then joint rates; and their
  /// derivatives.
  const VectorX<T>& v() const { return v_; }
  const VectorX<T>& v_dot() const { return v_dot_; }
  /// The end effector's motion in the world, from q, base, v and v_dot.
  ToolMotion<T> tool_motion() const;
  Pose<T> tool_pose() const { return base_ * kinematics_.end_effector(tool()); }
  /// With dependent joints: the largest of the six components of x_dot, and of x_ddot, that no
  /// motion of the robot provides [m/s, rad/s; m/s^2, rad/s^2].
  double twist_missed() const { return twist_missed_; }
  double acceleration_missed() const { return acceleration_missed_; }

 private:
  /// A body relative to the base, in base axes: the twist at its origin, and the derivatives there.
  struct Relative {
    Vector3<T> v = Vector3<T>::Zero(), w = Vector3<T>::Zero();
    Vector3<T> v_dot = Vector3<T>::Zero(), w_dot = Vector3<T>::Zero();
  };
  Relative along_chain(const Vector3<T>& p_e) const;
  const EndEffector& tool() const;
  void set_theta_r(const VectorX<T>& values, Eigen::Index first, VectorX<T>& all) const;
  void read_jacobian();
  void correct(const Pose<double>& x);
  Vector6<T> acceleration() const;
  double solve(const Vector6<T>& twist, VectorX<T>& velocities) const;

  const Problem* problem_;
  Kinematics<T> kinematics_;
  std::vector<int> chain_;  ///< joints, from the base outward
  VectorX<T> q_, v_, v_dot_;
  Pose<T> base_;
  // With dependent joints.
  std::vector<int> columns_;  ///< of J_d
  Matrix6X<T> J_;
  LeastSquares6 J_d_;  ///< of the values
  double twist_missed_ = 0, acceleration_missed_ = 0;
};

/// A `RobotMotion` at one instant after another. Dependent joints start on the IK solution of the
/// guess, at theta_r_default and the problem's pose, and continue from each instant to the next.
class RobotMotionTracker {
 public:
  /// The problem must outlive this object.
  explicit RobotMotionTracker(const Problem& problem);
  explicit RobotMotionTracker(const Problem&&) = delete;

  /// Makes the next instant the first one, at the start of the path.
  void restart() { started_ = false; }
  /// Moves to an instant. Returns null, or the reason why the dependent joints do not reach it;
  /// then they stay at the last point that they reached.
  const char* place(const Pose<double>& x, const Eigen::VectorXd& theta_r);
  /// Calls `place`, then computes the motion; of a transfer x does not count.
  const char* set(const PathPoint& x, const Eigen::VectorXd& theta_r, const Eigen::VectorXd& rate,
                  const Eigen::VectorXd& acceleration);
  const RobotMotion<double>& motion() const { return follower_; }
  /// With dependent joints, after `place`: z = [x, y, z, yaw of the base; all joints] and its
  /// derivative by theta_r.
  const DependentJoints& ik_solution() const { return *ik_solution_; }

 private:
  const Problem& problem_;
  RobotMotion<double> follower_;
  std::optional<DependentJoints> ik_solution_;
  Eigen::VectorXd q_;
  bool started_ = false;
  bool transfer_ = false;
};

}  // namespace maxwrench
