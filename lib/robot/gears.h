#pragma once

#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

// What gears (`Gear`) change in the chain to an end effector; see also `apply_gears` in chain.h.

/// The joints whose own motors move an end effector: those of the chain, and in place of a joint
/// with a gear its leader, which may be elsewhere. Each once, from the base outward.
std::vector<int> motors_to(const Robot& robot, int end_effector);

/// The joints with a gear that are between the base and an end effector, or whose leader is.
std::vector<int> gears_at(const Robot& robot, int end_effector);

/// The joints that lead one between the base and an end effector, each once.
std::vector<int> leaders_to(const Robot& robot, int end_effector);

/// Adds ratio times the column of each joint with a gear to that of its leader, and clears it: the
/// columns of a Jacobian by all velocities become those by the velocities that are free.
void fold_gears(const Robot& robot, Matrix6Xd& J);

}  // namespace maxwrench
