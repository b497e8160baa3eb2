#pragma once

#include "drawing/svg.h"

namespace maxwrench {

// Directions without a length. A torque in the plane is an arrow with two heads, and a torque about
// the line of sight is part of a circle. A force along the line of sight is the point or the tail
// of an arrow.

void draw_torque(Svg& svg, const Eigen::Vector2d& tail, const Eigen::Vector2d& tip,
                 const Paint& paint, double head);
/// `turn` > 0: counterclockwise.
void draw_turn(Svg& svg, const Eigen::Vector2d& centre, double radius, double turn,
               const Paint& paint, double head);
/// `towards` > 0: towards the viewer.
void draw_sight(Svg& svg, const Eigen::Vector2d& centre, double radius, double towards,
                const Paint& paint);

}  // namespace maxwrench
