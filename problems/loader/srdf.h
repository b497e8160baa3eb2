#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace maxwrench {

/// What an SRDF file (MoveIt's) says about a robot.
struct Srdf {
  /// `disable_collisions`: pairs of URDF links.
  std::vector<std::pair<std::string, std::string>> ignore;
  /// `group_state`: positions by joint [rad or m]. Two groups' states of one name are one state.
  std::map<std::string, std::map<std::string, double>> states;
};

/// Reads an SRDF. Groups only matter through their states.
Srdf read_srdf(const std::filesystem::path& file);

}  // namespace maxwrench
