#pragma once

#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

/// Chooses `count` redundant joints of a chain: those whose absence leaves the other coordinates
/// most able to follow. Adds a note to the robot that says which and why.
///
/// Let J(q) be the r rows of the end effector's Jacobian that have a rank, with its linear rows
/// divided by the mean distance of the end effector. The score of a set of dependent coordinates is
/// the mean, over 64 random postures within the limits, of the smallest singular value of their
/// columns of J. Joints leave the set one by one, each time the one that leaves the highest score;
/// of equal scores, the joint nearest to the base.
std::vector<int> choose_redundant(Robot& robot, int end_effector, const std::vector<int>& chain,
                                  int count);

}  // namespace maxwrench
