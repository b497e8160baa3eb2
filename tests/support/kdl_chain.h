#pragma once

#include <kdl/chain.hpp>

#include "maxwrench/robot.h"

namespace maxwrench {

/// A robot without IK solutions up to its first end effector, as a KDL chain that starts at the
/// base, whose axes are those of KDL's world.
KDL::Chain kdl_chain(const Robot& robot);

/// The same on six joints that move the base in the world: along x, y, z, about z, y, x.
KDL::Chain floating_kdl_chain(const Robot& robot);

}  // namespace maxwrench
