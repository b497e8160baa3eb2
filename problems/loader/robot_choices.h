#pragma once

#include "problems/loader/block.h"
#include "problems/loader/urdf_choices.h"

namespace maxwrench {

/// Reads what a robot's TOML file says about its URDF: `packages`, `collision.meshes`, the tables
/// `[joints]` and `[links]`, and which links carry end effectors.
UrdfChoices read_choices(const Block& root);

/// The matrix of [xx, yy, zz, xy, xz, yz].
Eigen::Matrix3d read_inertia(const Block& block, std::string_view key);

}  // namespace maxwrench
