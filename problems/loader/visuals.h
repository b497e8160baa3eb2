#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/robot.h"

namespace maxwrench {

/// What a part of a link looks like: an element `visual` of a URDF.
///
/// It is a body of unit size, stretched by `size` along its own axes: a box with edges of 1 m, a
/// cylinder about the z axis or a sphere, each of diameter 1 m and centred at its origin, or a
/// mesh.
struct Visual {
  enum class Kind { kBox, kCylinder, kSphere, kMesh };
  int link = 0;  ///< the link that carries it
  Kind kind = Kind::kMesh;
  Pose<double> placement;  ///< link -> visual
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
  std::string mesh;                                  ///< the file of a mesh
  std::optional<std::array<double, 4>> colour = {};  ///< red, green, blue, opacity, from 0 to 1
};

/// What the robot looks like, from the files that it was read from: `Robot` itself has what counts
/// for results. Empty if it was made in code, or its files have changed since.
///
/// @param packages  the folders of packages that the robot was loaded with
std::vector<Visual> read_visuals(const Robot& robot,
                                 const std::vector<std::filesystem::path>& packages);

}  // namespace maxwrench
