#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "problems/loader/urdf_choices.h"

namespace maxwrench {

/// A `group`: joints that move together.
struct SrdfGroup {
  /// `chain`: base link and tip link.
  std::vector<std::pair<std::string, std::string>> chains;
  /// `joint`, `link` and `group`.
  std::vector<std::string> joints, links, groups;
};

/// What an SRDF file (MoveIt's) says about a robot.
struct Srdf {
  /// `disable_collisions`: pairs of URDF links.
  std::vector<std::pair<std::string, std::string>> ignore;
  /// `group_state`: positions by joint [rad or m]. Two groups' states of one name are one state.
  std::map<std::string, std::map<std::string, double>> states;
  std::map<std::string, SrdfGroup> groups;  ///< by name
  /// `virtual_joint`: names of joints to the world, which no URDF has.
  std::set<std::string> virtual_joints;
};

/// Reads an SRDF.
Srdf read_srdf(const std::filesystem::path& file);

/// Returns what a group contains, with the groups in it.
///
/// @throws BadValue of `key` if the SRDF has no group of that name, or not all of the groups in it
GroupChoice choose_group(const Srdf& srdf, std::string_view key, const std::string& name);

/// Returns the positions of a named posture, by joint [rad or m].
///
/// @throws BadValue of `key` if the SRDF has none of that name
const std::map<std::string, double>& named_state(const Srdf& srdf, std::string_view key,
                                                 const std::string& name);

}  // namespace maxwrench
