#pragma once

#include <vector>

#include "maxwrench/types.h"

/// @file
/// The second contact: a second end effector that touches the environment.

namespace maxwrench {

struct Robot;

/// The set of points that the second end effector may touch.
enum class Surface {
  kPoint,  ///< one point
  kLine,   ///< a line: one regrasp coordinate [m]
  kPlane,  ///< a plane: two regrasp coordinates [m]
  kCircle  ///< a circle around a pipe: one regrasp coordinate [rad]
};

/// How a second end effector touches the environment.
///
/// The z axis of the contact frame points into the environment. The contact frame depends on the
/// regrasp coordinates s, which are the last coordinates of theta_r. With F = (R, p) the `frame`,
/// the contact frame is
///
///     kPoint  (no s)    (R, p)                      kLine   (s_1)       (R, p + s_1 R e_x)
///     kPlane  (s_1,s_2) (R, p + s_1 R e_x + s_2 R e_y)
///     kCircle (s_1)     (T R, p - radius T R e_z),  T = rotation by s_1 about R e_y through p
///
/// The last one is a pipe along R e_y that the end effector touches from outside. The allowed
/// wrenches turn with the contact frame: h_2 = C_2 w_2 in world axes at the contact point, with
/// C_2 = blkdiag(R(s), R(s)) C.
struct Contact {
  /// Index in `Robot::end_effectors`. Its arm shares no joint with that of the first end effector.
  int end_effector = 0;
  Surface surface = Surface::kPoint;  ///< the points that it may touch
  Pose<double> frame;                 ///< F, in the world [m]
  double radius = 0;                  ///< radius of kCircle [m]
  /// Basis of the wrenches [force; torque] that the robot may exert (6×l), in contact axes. It may
  /// have no column.
  Matrix6Xd C;
  Eigen::VectorXd w_min,  ///< lower limits of w_2 (l) [N or N m]; 0 if the robot may only push
      w_max;              ///< upper limits of w_2 (l) [N or N m]; infinity if there is none
  /// true: the axes of the end effector also follow those of the contact frame (a firm grasp).
  /// false: only its origin meets the contact point.
  bool holds_axes = false;
  /// The joints that depend on the contact, in the order of the arm. All others of the arm rest.
  std::vector<int> follow;
  /// Rest values of joints that nothing else determines (all joints) [rad or m].
  Eigen::VectorXd q_rest;
  double length_scale = 0.2;  ///< unit of length in the stacked Jacobian of `smallest_gain` [m]
  double sigma_min = 0.05;    ///< a posture is near singular if `smallest_gain` is below this [-]
  /// The number of singular values of the stacked Jacobian that count: the largest number that
  /// differ from zero in any posture.
  int rank = 0;

  /// Returns the number of regrasp coordinates: 0, 1 or 2.
  int coordinates() const {
    return surface == Surface::kPoint ? 0 : surface == Surface::kPlane ? 2 : 1;
  }
  /// Returns the number of coordinates of the second end effector that the contact fixes: 3 or 6.
  int rows() const { return holds_axes ? 6 : 3; }
};

/// Returns the contact frame in the world at the regrasp coordinates `s` (`Contact::coordinates`).
Pose<double> contact_pose(const Contact& contact, const double* s);

/// Returns the derivative of `contact_pose` by the regrasp coordinate i.
///
/// @param contact  the contact
/// @param s        the regrasp coordinates
/// @param i        the coordinate, from 0
/// @return the twist [linear; angular] of the contact frame at its origin, in world axes
Vector6d contact_twist(const Contact& contact, const double* s, int i);

/// Returns the smallest singular value [-] of the stacked Jacobian that counts.
///
/// It is the `Contact::rank`-th largest singular value of
///
///     [J_1; J_2]   (9 or 12)×n
///
/// where J_2 has its position rows only, or all six of a firm grasp. Lengths are in units of
/// `Contact::length_scale`: angular rows are multiplied by it, and columns of rotations divided by
/// it.
///
/// @param robot    the robot
/// @param contact  the second contact
/// @param J        Jacobian J_1 of the first end effector (6×n)
/// @param J_2      Jacobian of the second end effector at the contact point (6×n)
double smallest_gain(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                     const Matrix6Xd& J_2);

/// Returns whether `smallest_gain` is below `Contact::sigma_min`.
///
/// It uses the signs of pivots instead of singular values, which is cheaper. The arguments are
/// those of `smallest_gain`.
bool near_singular(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                   const Matrix6Xd& J_2);

/// Computes `Contact::rank` of a contact.
///
/// @param robot         the robot
/// @param end_effector  the end effector of the first contact
/// @param contact       the second contact
/// @return the rank
int stacked_rank(const Robot& robot, int end_effector, const Contact& contact);

/// Returns the largest rank of J_f over all postures.
///
/// J_f is (3 or 6)×d. It maps the rates of the d dependent joints (`Contact::follow`) to the rates
/// of the coordinates of the second end effector that the contact fixes. If the rank is less than
/// d, the contact does not determine the joints.
int dependent_rank(const Robot& robot, const Contact& contact);

}  // namespace maxwrench
