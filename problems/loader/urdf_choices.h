#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
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
  std::optional<Mimic> mimic;
};

/// The same about a link.
struct LinkChoice {
  std::optional<double> mass;
  std::optional<Eigen::Vector3d> com;
  std::optional<Eigen::Matrix3d> inertia;
  std::optional<MeshUse> meshes;
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
};

/// What is chosen for a link or joint of this name; the default if nothing is.
template <class Choice>
Choice choice_of(const std::map<std::string, Choice>& choices, const std::string& name) {
  const auto found = choices.find(name);
  return found == choices.end() ? Choice() : found->second;
}

}  // namespace maxwrench
