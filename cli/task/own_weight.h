#pragma once

#include "maxwrench/robot.h"

namespace maxwrench {

/// How a robot holds its own weight at rest, without contact, with the base at its mount.
struct OwnWeight {
  double share = 0;   ///< of the postures in which the effort of some joint exceeds its limit
  int weakest = -1;   ///< the joint with the largest effort relative to its limit
  double needed = 0;  ///< the largest effort of that joint [N m or N]
};

/// Samples postures within the limits, always the same ones. The efforts that hold the joints are
/// unique: a joint that a gear moves loads the gear and its leader.
OwnWeight own_weight(const Robot& robot, int samples);

}  // namespace maxwrench
