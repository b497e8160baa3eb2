#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "maxwrench/load.h"
#include "tests/support/support.h"

// URDFs that a test writes.

namespace maxwrench::urdf {

inline constexpr const char* kLimit = "<limit lower='-1' upper='2' effort='5' velocity='1'/>";

inline std::string link(const std::string& name, double mass = 1, const std::string& more = "") {
  return "<link name='" + name + "'><inertial><mass value='" + std::to_string(mass) +
         "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>" + more +
         "</link>";
}

inline std::string joint(const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& more = kLimit,
                         const std::string& type = "revolute") {
  return "<joint name='" + name + "' type='" + type + "'><origin xyz='1 0 0'/><parent link='" +
         parent + "'/><child link='" + child + "'/><axis xyz='0 1 0'/>" + more + "</joint>";
}

/// An arm of one joint that carries a finger with another joint.
class UrdfTest : public testing::Test {
 protected:
  Robot load(const std::string& urdf, const std::string& toml = "") {
    std::ofstream(folder_.path() / "robot.urdf") << "<robot>" + urdf + "</robot>";
    std::ofstream(folder_.path() / "robot.toml")
        << "name = 'r'\nurdf = 'robot.urdf'\nbase = { axes = [] }\n" + toml;
    return load_robot(folder_.path() / "robot.toml");
  }
  /// The robot of a whole TOML file beside the URDF of the last `load`.
  Robot load_toml(const std::string& toml) {
    std::ofstream(folder_.path() / "robot.toml") << "urdf = 'robot.urdf'\n" + toml;
    return load_robot(folder_.path() / "robot.toml");
  }
  /// `arm` on the way to the tool, `finger` beside it.
  Robot load_finger(const std::string& finger, const std::string& toml = "",
                    const std::string& type = "revolute") {
    return load(link("base") + link("upper") + link("hand") + joint("arm", "base", "upper") +
                    joint("finger", "upper", "hand", finger, type),
                "end_effectors.tool = { link = 'upper' }\n" + toml);
  }
  std::string rejection(const std::string& urdf, const std::string& toml = "") {
    try {
      load(urdf, toml);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

}  // namespace maxwrench::urdf
