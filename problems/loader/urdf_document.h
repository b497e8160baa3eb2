#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <filesystem>
#include <map>
#include <string>

namespace maxwrench {

/// A URDF file as urdfdom understands it, and what urdfdom forgets.
struct UrdfDocument {
  urdf::ModelInterfaceSharedPtr model;
  std::map<std::string, int> joint_order;  ///< position of each joint in the file
};

/// Refuses what is not XML, numbers that are missing or not finite, what is no tree of links with
/// shapes that we know, and what urdfdom refuses.
UrdfDocument read_urdf_document(const std::filesystem::path& file);

}  // namespace maxwrench
