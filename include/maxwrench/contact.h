#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

struct Robot;

/// The set of points at which the second end effector may touch.
enum class Surface { kPoint, kLine, kPlane, kCircle };

/// How a second end effector touches the environment. The contact frame has its z axis into the
/// environment. Its place depends on the regrasp coordinates s, which theta_r ends with: with F =
/// (R, p) the `frame`,
///
///     kPoint  (no s)    (R, p)                      kLine   (s_1)       (R, p + s_1 R e_x)
///     kPlane  (s_1,s_2) (R, p + s_1 R e_x + s_2 R e_y)
///     kCircle (s_1)     (T R, p - radius T R e_z),  T = turn by s_1 about R e_y through p,
///
/// the last a pipe along R e_y that is touched from outside. The allowed wrenches turn with the
/// frame: h_2 = C_2 w_2 in world axes at the contact point, C_2 = blkdiag(R(s), R(s)) C.
struct Contact {
  int end_effector = 0;  ///< of the robot, on an arm that shares no joint with the first
  Surface surface = Surface::kPoint;
  Pose<double> frame;  ///< in the world [m]
  double radius = 0;   ///< m, of kCircle
  /// C 6×l [force; torque], in contact axes: what the robot may exert. May have no column.
  Matrix6Xd C;
  Eigen::VectorXd w_min, w_max;  ///< l [N or N m]; 0 and infinity: it may only push
  /// The end effector's frame follows the contact frame's axes too (a firm grasp); otherwise its
  /// origin alone meets the contact point.
  bool holds_axes = false;
  /// The joints that follow from the contact, in the order of the arm; all others of the arm rest.
  std::vector<int> follow;
  Eigen::VectorXd q_rest;  ///< all joints; where those rest that nothing else decides [rad or m]
  /// Singular: the smallest of the singular values of the stacked J that count is below sigma_min
  /// [-], with lengths in units of length_scale [m]. `rank` of them count, the largest number that
  /// differ from zero in any posture.
  double length_scale = 0.2;
  double sigma_min = 0.05;
  int rank = 0;

  int coordinates() const {
    return surface == Surface::kPoint ? 0 : surface == Surface::kPlane ? 2 : 1;
  }
  int rows() const { return holds_axes ? 6 : 3; }
};

/// The contact frame in the world at the regrasp coordinates s.
Pose<double> contact_pose(const Contact& contact, const double* s);

/// The twist [linear; angular] in world axes of the contact frame, at its origin, along coordinate
/// i: the derivative of `contact_pose` by s_i.
Vector6d contact_twist(const Contact& contact, const double* s, int i);

/// The smallest singular value [-] that counts, the `rank`-th largest of
///
///     [J_1; J_2]   (9 or 12)×n, of J_2 the position rows, all six of a firm grasp,
///
/// in units of length_scale: angular rows times it, columns of rotations divided by it.
double smallest_gain(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                     const Matrix6Xd& J_2);

/// smallest_gain < sigma_min, from the signs of pivots instead of singular values: cheaper.
bool near_singular(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                   const Matrix6Xd& J_2);

/// `rank` of a contact, while `end_effector` makes the first.
int stacked_rank(const Robot& robot, int end_effector, const Contact& contact);

/// In how many independent ways the joints that follow move the second end effector, as far as the
/// contact fixes it: the largest rank of J_f (3 or 6)×d over all postures. With fewer than d the
/// contact leaves them free.
int dependent_rank(const Robot& robot, const Contact& contact);

}  // namespace maxwrench
