#pragma once

#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// The coordinates x of a posture, all of them:
///
///     x = [theta_r; dependent joints; joints of a second arm; yaw of the base],
///
/// the yaw where the base's pose does not follow in closed form and that axis is free. As variables
/// of forms they stand in this order: the second arm; the yaw; the joints from the base to the end
/// effector; what is free of its pose; the regrasp coordinates.
struct PostureCoordinates {
  struct Variable {
    bool turns = true;
    int coordinate = 0;  ///< of x
    double lower = 0, upper = 0;
  };

  /// Throws std::invalid_argument, in one line, for tasks in time, a second contact that exerts
  /// forces, and joints of theta_r that do not move the end effector.
  explicit PostureCoordinates(const Problem& problem);

  std::vector<Variable> variables;
  std::vector<int> of_joint;  ///< the variable of each joint of the robot; -1: it rests
  std::vector<int> chain;     ///< the joints that move the end effector, from the base outward
  int yaw = 0;                ///< where each stretch of variables begins
  int first = 0, free = 0, regrasp = 0;
  bool base_is_dependent = false;  ///< its pose, in closed form; else by equations

  int count() const { return static_cast<int>(variables.size()); }
  bool has_yaw() const { return first > yaw; }
};

/// Where a joint rests that is no coordinate.
double rest_of(const Problem& problem, std::size_t joint);

}  // namespace maxwrench
