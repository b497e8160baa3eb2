#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "maxwrench/task.h"
#include "problems/mesh/find_mesh.h"

namespace maxwrench {

/// What becomes of a mesh in `collision`.
enum class MeshUse { kHull, kCapsules, kIgnore };

/// A mesh as a shape, or why there is none.
struct MeshShape {
  std::optional<Shape> shape;  ///< in the axes of the mesh; link, body and placement: see below
  std::filesystem::path file;  ///< where the mesh was found, or empty
  /// One line for a report: "hull of 64 of 812 vertices, grown by 0.8 mm", or, without a shape,
  /// what is wrong and where it was looked for.
  std::string note;
};

/// The meshes of one robot as shapes. A file is read once for each scale and kind.
class MeshShapes {
 public:
  /// Takes the URDF, and folders with packages that are looked into first (see `find_mesh`).
  MeshShapes(std::filesystem::path urdf, std::vector<std::filesystem::path> packages)
      : urdf_(std::move(urdf)), packages_(std::move(packages)) {}

  /// The shape of the mesh with this name in the URDF, scaled along the axes of the mesh. A scale
  /// below zero mirrors it, as left and right sides of public URDFs do.
  ///
  /// The placement of a capsule is that of its centre in the axes of the mesh, and the identity for
  /// a hull. The caller multiplies it by the origin of the <collision> from the left, and sets link
  /// and body.
  ///
  /// A mesh that is missing or damaged is no error but has no shape. `use` is not kIgnore.
  /// Throws BadValue with the key "scale" if the scale is not three finite numbers other than zero.
  MeshShape shape(const std::string& uri, const Eigen::Vector3d& scale, MeshUse use);

  /// Where the mesh with this name in the URDF is.
  FoundMesh find(const std::string& uri) const { return find_mesh(uri, urdf_, packages_); }

 private:
  using Key = std::tuple<std::string, double, double, double, MeshUse>;

  std::filesystem::path urdf_;
  std::vector<std::filesystem::path> packages_;
  std::map<Key, MeshShape> known_;
};

}  // namespace maxwrench
