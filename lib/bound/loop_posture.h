#pragma once

#include "lib/bound/multi_affine.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// All coordinates x of a posture whose joints follow by equations:
///
///     x = [theta_r; dependent joints; yaw of the base, if it is free].
///
/// Its chain leads from the world to the end effector: yaw of the base, the joints from the base
/// outward, the free coordinates of the end effector's pose. Angles are within one turn.
struct LoopCoordinates {
  explicit LoopCoordinates(const Problem& problem);

  Coordinates chain;             ///< as indices of x
  std::vector<int> joints;       ///< of the robot, along the chain
  int first = 0;                 ///< where joints begin in `chain`
  Eigen::VectorXd lower, upper;  ///< limits of x
};

/// What a posture is made of at any x, with the digits of `Extended`. All of it is multi-affine:
/// weight and contact force load joint i through the joints behind it alone, turned once by each,
/// from the end effector's pose; and the base through its yaw.
///
/// Where x is a posture, the pose of the base in its mount, less what is free, is
///
///     Rz(yaw) T_1(q_1) ... T_k(q_k) = mount^-1 X(s) (T_k+1(q_k+1) ... T_n(q_n))^-1
///
/// in all rows of the rotation, and those of the position that no free axis moves.
class LoopPosture {
 public:
  /// Keeps references.
  LoopPosture(const Problem& problem, const LoopCoordinates& coordinates);

  void set(const ExtendedVector& x);

  /// [tau_d; J'c], 2n.
  const ExtendedVector& loads() const { return loads_; }
  /// The rows of either side of the equations, k joints on the left.
  ExtendedVector left(int k) const;
  ExtendedVector right(int k) const;

 private:
  ExtendedVector rows_of(const Pose<Extended>& pose) const;
  Pose<Extended> link(int k) const;

  const Problem& problem_;
  const LoopCoordinates& coordinates_;
  const EndEffector& tip_;
  Kinematics<Extended> kinematics_;
  Pose<Extended> yaw_, target_;  ///< of the base; mount^-1 X(s)
  ExtendedVector q_, loads_, tau_;
  Matrix6X<Extended> J_;
};

}  // namespace maxwrench
