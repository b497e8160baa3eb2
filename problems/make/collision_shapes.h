#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

/// Checks shapes, names and margin of `collision`, and sets `Robot::convex_bodies` and
/// `Robot::collision`. Shapes without a body's name take that of their link. The links must be
/// checked.
void set_collision(Robot& robot, const Collision& collision);

}  // namespace maxwrench
