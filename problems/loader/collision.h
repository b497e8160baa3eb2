#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// Checks all pairs of shapes on different links, except those whose bodies are named in `ignore`:
/// a posture collides if two shapes of a pair are closer than `margin` [m]. Null if there is no
/// pair.
///
/// Capsules and spheres against each other and against boxes are exact and allocate nothing. Pairs
/// with a cylinder and pairs of boxes go to FCL as intersection tests of shapes of which one is
/// grown by the margin: exact if one of them is a capsule, otherwise on the safe side by at most
/// 0.74 margin at edges and corners. FCL's distances are not used: in version 0.7 they can be wrong
/// or throw, while its intersection tests agree with the exact ones (see collision_test.cpp).
std::shared_ptr<const CollisionChecker> make_collision_checker(
    std::vector<Shape> shapes, const std::vector<std::pair<std::string, std::string>>& ignore,
    double margin);

/// The shape as a convex body; a cylinder as a prism of 32 faces.
ConvexBody to_convex_body(const Shape& shape);

}  // namespace maxwrench
