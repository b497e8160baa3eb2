#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

// An independent model of a robot on a free base: its files. It shares no code with the library,
// not even the parsers, and knows only what the robots of its tests use.

namespace maxwrench::reference {

/// A link of the URDF, fixed or not, with what the TOML says of it.
struct Body {
  std::string name;
  // The joint that carries it; the root has none.
  std::string joint;
  int parent = -1;      ///< an earlier body
  int coordinate = -1;  ///< of q; -1: fixed
  bool slides = false;
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< URDF's default
  double effort = 0;
  // Its inertia, buoyancy, added mass and drag.
  double mass = 0, volume = 0;
  Eigen::Vector3d com = Eigen::Vector3d::Zero(), cob = Eigen::Vector3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::VectorXd added_mass = Eigen::VectorXd::Zero(6);
  Eigen::VectorXd damping_linear = Eigen::VectorXd::Zero(6);
  Eigen::VectorXd damping_quadratic = Eigen::VectorXd::Zero(6);
};

struct Tool {
  std::string name;
  int body = 0;
  Eigen::Vector3d xyz, rpy;
};

struct Files {
  std::vector<Body> bodies;
  std::vector<std::string> joints;  ///< by coordinate
  std::vector<int> axes;            ///< the base's free ones of x, y, z, roll, pitch, yaw
  std::vector<Tool> tools;
  double gravity = 0, density = 0, trim_mass = 0;
  Eigen::Vector3d trim_place = Eigen::Vector3d::Zero();
  Eigen::MatrixXd B;  ///< (6 + joints)×m, thrusters, then joints
  Eigen::VectorXd u_min, u_max;
};

/// Throws std::runtime_error on what it does not understand.
Files read_robot(const std::filesystem::path& toml);

}  // namespace maxwrench::reference
