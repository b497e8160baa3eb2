#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "problems/loader/block.h"
#include "problems/loader/urdf_tree.h"
#include "problems/state.h"

namespace maxwrench {
namespace {

/// The base of a robot stays where its axes do not lead.
void require_free_axes(const Block& theta, std::string_view key, const Eigen::Vector3d& values,
                       int first, const Robot& robot) {
  constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "roll", "pitch", "yaw"};
  for (int i = 0; i < 3; ++i) {
    const auto& free = robot.base_axes;
    if (values[i] == 0 || std::find(free.begin(), free.end(), first + i) != free.end()) continue;
    const char* name = kNames[static_cast<std::size_t>(first + i)];
    theta.refuse_value(key,
                       fmt::format("{} = 0, because {} is not among the base's axes", name, name));
  }
}

Eigen::VectorXd read_velocities(const Block& root, std::string_view key, const Robot& robot) {
  if (!root.has(key)) return Eigen::VectorXd::Zero(robot.velocities());
  return root.numbers(key, robot.velocities());
}

}  // namespace

State load_state(const std::filesystem::path& file, const Robot& robot) {
  const Block root = Block::read(file);
  root.allow_only({"theta", "velocity", "acceleration"});
  const Block theta = root.table("theta");
  std::vector<std::string_view> keys = {"position", "rpy"};
  for (const Joint& joint : robot.joints) keys.push_back(joint.name);
  theta.allow_only(keys);
  State state;
  const Eigen::Vector3d position = theta.vector("position"), rpy = theta.vector("rpy");
  require_free_axes(theta, "position", position, 0, robot);
  require_free_axes(theta, "rpy", rpy, 3, robot);
  state.base = pose_from_xyz_rpy(position, rpy);
  state.q.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    state.q[static_cast<Eigen::Index>(i)] = theta.number(robot.joints[i].name);
  }
  state.velocity = read_velocities(root, "velocity", robot);
  state.acceleration = read_velocities(root, "acceleration", robot);
  return state;
}

}  // namespace maxwrench
