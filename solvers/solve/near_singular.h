#pragma once

#include <optional>
#include <string>

#include "maxwrench/solve.h"

namespace maxwrench {

/// What is left of a value if one joint is a little off.
struct JointOff {
  std::string joint;
  double by = 0;    ///< [rad]
  double beta = 0;  ///< the value then, with other efforts and, if it is free, another wrench
};

/// Whether the posture of a value is near singular along c: where the motors feel hardly anything
/// of a wrench along c, because J'c is small in the rows of all joints, the structure bears it, and
/// the value is as large as the posture is exact.
///
/// With q_i 0.01 rad off, J and the load at rest are those of the robot's base at rest and q + 0.01
/// e_i; the lever arms of the wrench, the entries of J'c, change by at most 0.01 of the distance
/// between the joint and the end effector. So the value changes much only if all of those that
/// limit it are not much longer than that.
///
/// @return the joint of the chain to the end effector, and the sign, that leave least, if that is
///         less than half of the value. Nothing for tasks in time, with a second contact or a list,
///         and for values of another unit than the wrench
std::optional<JointOff> find_joint_off(const Answer& answer);

}  // namespace maxwrench
