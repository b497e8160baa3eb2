#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "problems/mesh/mesh_shape.h"

namespace maxwrench {

/// `mimic` of a joint: q = ratio q_leader + offset.
struct Mimic {
  std::string leader;
  double ratio = 1, offset = 0;
};

/// What the robot's TOML says about a joint. It counts more than the URDF.
struct JointChoice {
  std::optional<double> effort, velocity, lower, upper;
  std::optional<double> lock;  ///< the joint stays at this position
  bool rest_given = false;     ///< `lock` is from the key `rest`, so it must be within the limits
  bool rests = false;          ///< it stays at zero, or at its limit nearest to zero
  std::optional<Mimic> mimic;
};

/// The same about a link.
struct LinkChoice {
  std::optional<double> mass;
  std::optional<Eigen::Vector3d> com;
  std::optional<Eigen::Matrix3d> inertia;
  std::optional<MeshUse> meshes;
};

/// The group of an SRDF whose joints alone move.
struct GroupChoice {
  std::string name;
  std::vector<std::pair<std::string, std::string>> chains;  ///< base link and tip link
  std::vector<std::string> joints, links;
  /// Where joints outside stay [rad or m]: those of `rest` have to be outside, `state` may have
  /// any.
  std::map<std::string, double> rest, state;
};

/// How to read a URDF.
struct UrdfChoices {
  std::vector<std::filesystem::path> packages;  ///< where `package://` is searched first
  MeshUse meshes = MeshUse::kHull;
  std::map<std::string, JointChoice> joints;
  std::map<std::string, LinkChoice> links;
  /// The links that carry end effectors. A joint that carries none of them and has no effort is
  /// locked. Empty: no joint is.
  std::set<std::string> tips;
  std::map<std::string, double> positions;  ///< where such a joint stays; at rest if it has none
  std::optional<GroupChoice> group;         ///< none: all joints move
};

/// What is chosen for a link or joint of this name; the default if nothing is.
template <class Choice>
Choice choice_of(const std::map<std::string, Choice>& choices, const std::string& name) {
  const auto found = choices.find(name);
  return found == choices.end() ? Choice() : found->second;
}

}  // namespace maxwrench
