#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "maxwrench/task.h"
#include "problems/loader/urdf_choices.h"
#include "problems/loader/urdf_element.h"
#include "problems/loader/visuals.h"

namespace maxwrench {

/// The place of a URDF link in the robot: part of a link, at a fixed pose.
struct Body {
  int link = 0;
  Pose<double> placement;  ///< link of the robot -> URDF link
};

/// The contents of a URDF file. Links on joints that are fixed or locked are merged into the link
/// that carries them.
struct UrdfTree {
  std::string name;  ///< of the element <robot>; the file's if it has none
  std::string root;
  std::vector<Link> links;  ///< named after the URDF link that their joint moves
  std::vector<Joint> joints;
  std::map<std::string, Body> bodies;   ///< by name of the URDF link
  std::vector<BodyPart> parts;          ///< one for each URDF link
  std::vector<std::string> leaves;      ///< the URDF links without children that a joint moves
  std::set<std::string> undriven;       ///< joints that are locked because they have no effort
  std::vector<std::string> group_tips;  ///< of `UrdfChoices::group`: the links at its ends
  std::vector<Shape> shapes;
  std::vector<Visual> visuals;
  std::vector<std::string> warnings, notes, files;  ///< as in `Robot`
  std::vector<DataFault> no_dynamics;               ///< likewise
};

/// Reads a URDF file. Links and joints are in depth-first order from the root, siblings in the
/// order of the file.
UrdfTree read_urdf(const std::filesystem::path& file, const UrdfChoices& choices = {});

/// The pose of a URDF origin: rotations about the fixed axes x, y, z, in this order.
Pose<double> pose_from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy);

/// The pose in the element `origin`; the identity if there is none.
Pose<double> origin_of(const UrdfElement& element);

}  // namespace maxwrench
