#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// Triangles of a mesh.
struct Triangles {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;  ///< indices of points, counterclockwise from outside
  std::optional<std::array<double, 3>> colour = {};  ///< red, green, blue, from 0 to 1
};

/// Reads the vertices of all meshes of a file, each one once, in metres and in the axes of the
/// file. The formats are STL, DAE, OBJ, PLY, GLB and glTF, by Assimp.
///
/// Nodes of the file's scene move their meshes. The unit of a COLLADA file (.dae) counts. Its
/// up_axis does not: rviz, MoveIt and Gazebo ignore it, so URDFs are written for that.
///
/// Throws std::invalid_argument with one line, `<file>: mesh: got ..., expected ...`, if the file
/// is not a regular one, is longer than 200 MB, is damaged, nests or repeats its parts without
/// bound, or has no vertices or some that are not finite.
std::vector<Eigen::Vector3d> read_mesh(const std::filesystem::path& file);

/// The same with the triangles between the vertices, which may repeat. Faces with more corners are
/// divided. There is one part for each colour; only COLLADA and glTF files have colours.
std::vector<Triangles> read_parts(const std::filesystem::path& file);

}  // namespace maxwrench
