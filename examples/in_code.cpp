// A robot and a task without a file: a planar vehicle with an arm.
#include <cstdio>
#include <exception>
#include <numbers>

#include "maxwrench/solve.h"
#include "maxwrench/task.h"

using namespace maxwrench;

int main() try {
  const Eigen::Matrix3d rod = Eigen::Vector3d(5e-6, 8.75e-5, 8.75e-5).asDiagonal();  // kg m^2
  const Eigen::Matrix3d box = Eigen::Vector3d(0.15, 0.32, 0.43333).asDiagonal();
  Robot robot;
  robot.base_axes = {0, 1, 5};  // x, y, yaw
  robot.links = {{.name = "hull", .mass = 10, .inertia = box},
                 {.name = "link_1", .mass = 0.1, .com = {0.05, 0, 0}, .inertia = rod},
                 {.name = "link_2", .mass = 0.1, .com = {0.05, 0, 0}, .inertia = rod}};
  const double limit = std::numbers::pi / 3;                                // rad
  robot.joints = {{.name = "shoulder", .placement = {.p = {0.3, 0.1, 0}}},  // about z
                  {.name = "elbow", .parent = 1, .placement = {.p = {0.1, 0, 0}}}};
  for (Joint& joint : robot.joints) joint.q_min = -limit, joint.q_max = limit, joint.effort_max = 1;
  for (const double x : {0.3, -0.3}) {
    for (const double y : {0.2, -0.2}) {
      const std::string name = std::string(x > 0 ? "front" : "rear") + (y > 0 ? "_left" : "_right");
      robot.thrusters.push_back({name, {x, y, 0}, {4, x * y > 0 ? -1.0 : 1.0, 0}, -1, 1});
    }
  }
  robot.end_effectors = {{.name = "tool", .link = 2, .placement = {.p = {0.1, 0, 0}}}};
  TaskSpec task{.name = "push", .robot = finalize(robot), .end_effector = "tool"};
  task.pose.R = Eigen::AngleAxisd(std::numbers::pi / 18, Eigen::Vector3d::UnitZ());
  task.c << 1, 0, 0, 0, 0, 0;
  std::printf("%s", summary(solve(make_problem(task))).c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "in_code: %s\n", error.what());
  return 2;
}
