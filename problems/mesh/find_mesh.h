#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace maxwrench {

/// Where a mesh was looked for.
struct FoundMesh {
  std::filesystem::path file;      ///< a regular file, or a path that is none; empty: not found
  std::vector<std::string> tried;  ///< the first few paths where nothing was
};

/// Finds the file that a URDF names as a mesh.
///
/// A path is relative to the URDF. `file://` names a file. `package://PKG/REST` and
/// `model://PKG/REST` are looked up, in this order:
///
/// 1. in `packages`, then in the folders of MAXWRENCH_PACKAGE_PATH and of ROS_PACKAGE_PATH. Each of
///    these is PKG itself, or contains PKG, or contains src/PKG or */PKG;
/// 2. in share/PKG of the folders of AMENT_PREFIX_PATH;
/// 3. above the URDF, from its folder upwards: where a folder is PKG, or contains PKG, or contains
///    REST.
///
/// %20 and its like are read as in a URL. The extension may differ in upper and lower case.
FoundMesh find_mesh(const std::string& uri, const std::filesystem::path& urdf,
                    const std::vector<std::filesystem::path>& packages);

}  // namespace maxwrench
