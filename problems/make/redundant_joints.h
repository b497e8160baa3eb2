#pragma once

#include <string_view>
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
/// of equal scores, the joint nearest to the base. `leaders`, joints of the chain that move others
/// by gears, leave it first.
std::vector<int> choose_redundant(Robot& robot, int end_effector, const std::vector<int>& chain,
                                  const std::vector<int>& leaders, int count);

/// Rejects an end effector whose chain has a joint that a gear moves, or that moves another by a
/// gear.
void require_no_gears(std::string_view key, const Robot& robot, int end_effector);

/// Rejects more leaders than joints to choose: inverse kinematics moves joints one by one, so
/// leaders must be given.
void require_redundant_leaders(const Robot& robot, const std::vector<int>& leaders, int count);

}  // namespace maxwrench
