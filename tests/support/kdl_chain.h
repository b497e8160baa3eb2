#pragma once

#include <kdl/chain.hpp>

#include "maxwrench/robot.h"

namespace maxwrench {

/// The chain from the base to the first end effector, of a robot that has no other chain, as a KDL
/// chain. The base has the axes of KDL's world.
KDL::Chain kdl_chain(const Robot& robot);

/// The same after six joints that move the base in the world: along x, y, z, about z, y, x.
KDL::Chain floating_kdl_chain(const Robot& robot);

}  // namespace maxwrench
