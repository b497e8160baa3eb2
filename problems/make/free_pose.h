#pragma once

#include "maxwrench/problem.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Reads which coordinates of `[pose]` a static task leaves free, and adds them to theta_r, which
/// the joints have filled. A task in time is refused them.
void read_free_pose(const Block& task, Problem& problem);

/// Refuses coordinates along which the end effector cannot move, and those along which the wrenches
/// that do work change. `problem` has its atlas.
void require_free_motions(const Block& task, const Problem& problem);

}  // namespace maxwrench
