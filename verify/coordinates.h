#pragma once

#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// Whether a second contact has all three forces, without limits, and no torques, on a base that
/// moves along all six axes. The balance of the base's forces then determines them.
bool forces_follow_from_base(const Problem& problem);

/// Which coordinates a posture has besides those that it always has.
struct CoordinateChoice {
  int without = -1;             ///< a joint of the chain that rests; -1: none
  bool contact_shares = false;  ///< `ContactLimits`
};

/// All coordinates x of a posture:
///
///     x = [theta_r; dependent joints; joints of a second arm; yaw of the base; contact shares].
///
/// The yaw is a coordinate if the base's pose has no closed form and this axis is free. As
/// variables of forms, the coordinates have this order: the second arm; the yaw; the joints from
/// the base to the end effector; the free coordinates of its pose; the regrasp coordinates; the
/// shares.
struct PostureCoordinates {
  struct Variable {
    bool turns = true;
    int coordinate = 0;  ///< index in x
    double lower = 0, upper = 0;
  };

  /// Throws std::invalid_argument, in one line, for tasks in time and for joints of theta_r that do
  /// not move the end effector.
  explicit PostureCoordinates(const Problem& problem, const CoordinateChoice& choice = {});

  std::vector<Variable> variables;
  std::vector<int> of_joint;  ///< the variable of each joint of the robot; -1 if it rests
  std::vector<int> chain;     ///< the joints that move the end effector, from the base outward
  int yaw = 0;                ///< first index of each stretch of variables
  int first = 0, free = 0, regrasp = 0, shares = 0;
  bool base_is_dependent = false;  ///< its pose has a closed form; else equations
  int resting = -1;                ///< `CoordinateChoice::without`

  int count() const { return static_cast<int>(variables.size()); }
  bool has_yaw() const { return first > yaw; }
  bool has_shares() const { return count() > shares; }
};

/// The first joint of the chain, if it is of theta_r and turns about the yaw of a base that moves
/// along x, y and yaw, has no closed form and is not loaded by a second contact; else -1. Such a
/// base can turn in place of the joint. For any posture, the one with this joint at rest, another
/// yaw and another place of the base has the same end effector and the same links from this joint
/// on, so their joints have the same loads. The rows of the base and of other branches may differ,
/// and so may collisions between these links and others.
int joint_about_yaw(const Problem& problem);

/// Whether the base moves along an axis (0 to 2) or about one (3 to 5).
bool is_free(const Robot& robot, int axis);

/// The position of a joint that is not a coordinate.
double rest_of(const Problem& problem, std::size_t joint);

}  // namespace maxwrench
