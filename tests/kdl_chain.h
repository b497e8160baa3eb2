#pragma once

#include <kdl/chain.hpp>

#include "lib/robot.h"

namespace maxwrench {

/// An arm that is one chain, as KDL sees it in the axes of the base, with its masses.
KDL::Chain kdl_chain(const Robot& robot);

}  // namespace maxwrench
