#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// Checks all pairs of shapes on different links, except pairs of bodies listed in `ignore`. A
/// posture collides if two shapes of a pair are closer than `margin` [m]. Null if there is no pair.
///
/// The tests of capsules and spheres with each other and with boxes are exact and allocate nothing.
/// Pairs with a cylinder and pairs of boxes use intersection tests of FCL, with one of the two
/// shapes grown by the margin. These are exact if one shape is a capsule. Otherwise they are
/// conservative by at most 0.74 margin at edges and corners. FCL's distances are not used: in
/// version 0.7 they can be wrong or throw, while its intersection tests agree with the exact ones
/// (see collision_test.cpp). Pairs with a hull use GJK, which is exact, allocates nothing and also
/// gives the distance.
std::shared_ptr<const CollisionChecker> make_collision_checker(
    std::vector<Shape> shapes, const std::vector<std::pair<std::string, std::string>>& ignore,
    double margin);

/// The shapes, ignored pairs and margin from which `make_collision_checker` makes the same checker.
/// None if it did not make this one.
std::optional<Collision> made_of(const CollisionChecker& checker);

}  // namespace maxwrench
