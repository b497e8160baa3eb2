#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/robot.h"
#include "problems/loader/urdf_choices.h"
#include "problems/loader/urdf_structure.h"

namespace maxwrench {

/// A joint of a URDF file, not placed in the robot yet.
struct UrdfJoint {
  Joint joint;                   ///< without parent and placement
  std::optional<double> locked;  ///< the position in which it stays; 0 for a fixed joint
  bool undriven = false;         ///< it is locked because it has no effort
  std::optional<Mimic> mimic;    ///< of a joint that moves with another one that is not locked
};

/// Reads all joints by name. A file as its maker publishes it may lack what a task does not need.
/// Each such place adds a line to `warnings`:
///
/// * No effort: it counts as zero on the way to an end effector; elsewhere the joint is locked,
///   where `UrdfChoices::positions` has it.
/// * No velocity, or zero: there is no limit.
/// * No limits of a revolute joint: ±pi. Of a prismatic one: locked.
/// * An axis of zero, and the types floating and planar: locked.
/// * A joint that mimics a locked one is locked. One that mimics itself over others, or a joint
///   that the file does not have, is locked too.
std::map<std::string, UrdfJoint> read_joints(const UrdfStructure& structure,
                                             const UrdfChoices& choices,
                                             std::vector<std::string>& warnings);

}  // namespace maxwrench
