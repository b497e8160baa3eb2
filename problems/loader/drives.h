#pragma once

#include "maxwrench/robot.h"
#include "problems/loader/block.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {

/// The link of the URDF with this name. Rejects a name that is not one.
const Body& find_body(const UrdfTree& tree, const Block& block, std::string_view key,
                      const std::string& name);

/// Reads the table `[thrusters]`.
void read_thrusters(const Block& thrusters, const UrdfTree& tree, Robot& robot);

/// Reads the table `[wheels]`. A wheel becomes forces of limited size along lines that are fixed to
/// the base, which are thrusters of the robot:
///
/// * `mecanum`: one force along the axis of the roller on the ground, at `roller` from the rolling
///   direction. The motor's part along that direction is force cos(roller).
/// * `omni`: one force along the rolling direction; the rollers let the wheel slide sideways.
/// * `plain`: one force along the rolling direction, and friction sideways, named NAME_side.
///
/// Each is at most what the motor drives, `force`, and what friction holds, mu load.
void read_wheels(const Block& wheels, const UrdfTree& tree, Robot& robot);

/// Reads the tables `[limits.NAME]`, and replaces the limits of the robot by those of the `chosen`
/// name, unless that is empty. The robot has its thrusters and joints.
void read_limits(const Block& root, const std::string& chosen, Robot& robot);

/// Adds the brakes of a parked base: forces and torques along its free axes that exceed any load.
void add_brakes(Robot& robot);

}  // namespace maxwrench
