#include "tests/support/snake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <vector>

namespace maxwrench {
namespace {

std::string inertial(double mass) {
  return fmt::format(
      "<inertial><mass value=\"{}\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" "
      "iyz=\"0\" izz=\"0.1\"/></inertial>",
      mass);
}

/// Joints alternately about y and z, 0.12 m apart.
std::string urdf_text(int joints) {
  std::string text = "<robot name=\"snake\">\n<link name=\"link_0\">" + inertial(15) + "</link>\n";
  for (int i = 1; i <= joints; ++i) {
    text += fmt::format(
        "<link name=\"link_{0}\">{1}</link>\n<joint name=\"q{0}\" type=\"revolute\">"
        "<parent link=\"link_{2}\"/><child link=\"link_{0}\"/><origin xyz=\"0.12 0 0\"/>"
        "<axis xyz=\"{3}\"/><limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"1\"/>"
        "</joint>\n",
        i, inertial(0.2), i - 1, i % 2 == 0 ? "0 0 1" : "0 1 0");
  }
  return text + "</robot>\n";
}

std::string robot_text(int joints) {
  std::string text =
      "name = \"snake\"\nurdf = \"robot.urdf\"\nsource = \"made by a test\"\n"
      "[base]\naxes = [\"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\"]\n"
      "[environment]\ngravity = 9.81\nwater_density = 0\n"
      "[thrusters]\nforce_min = -100\nforce_max = 120\n";
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.2, 0.2}) {
      text += fmt::format(
          "[[thrusters.list]]\nname = \"h{0}{1}\"\nposition = [{0}, {1}, 0]\n"
          "direction = [1, {2}, 0]\n[[thrusters.list]]\nname = \"v{0}{1}\"\n"
          "position = [{0}, {1}, 0]\ndirection = [0, 0, 1]\n",
          x, y, x * y > 0 ? 1 : -1);
    }
  }
  return text +
         fmt::format("[end_effectors.tool]\nlink = \"link_{}\"\nxyz = [0.1, 0, 0]\n", joints);
}

std::string task_text(int joints) {
  std::vector<std::string> names;
  for (int i = 1; i <= joints; ++i) names.push_back(fmt::format("\"q{}\"", i));
  return fmt::format(
      "type = \"static\"\nrobot = \"robot.toml\"\nend_effector = \"tool\"\n"
      "label = \"made up\"\nsource = \"made by a test\"\n[pose]\nxyz = [0, 0, 0]\nrpy = [0, 0, 0]\n"
      "[wrench]\nc = [1, 0, 0, 0, 0, 0]\n[theta_r]\njoints = [{}]\ndefault = [{}]\n",
      fmt::join(names, ", "), fmt::join(std::vector<double>(names.size(), 0.1), ", "));
}

}  // namespace

Snake::Snake(int joints) {
  std::ofstream(path() / "robot.urdf") << urdf_text(joints);
  std::ofstream(path() / "robot.toml") << robot_text(joints);
  std::ofstream(path() / "task.toml") << task_text(joints);
}

}  // namespace maxwrench
