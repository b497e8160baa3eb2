#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maxwrench/load.h"
#include "problems/loader/block.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

/// Rejects a displacement of the base from its mount along axes that are not free, beyond rounding.
void require_free_axes(const Block& theta, const Pose<double>& base, const Robot& robot) {
  constexpr double kRounding = 1e-9;
  if (robot.base_axes.size() == kTwistAxes.size()) return;
  const Pose<double> moved = robot.mount.inverse() * base;
  Vector6d along;
  along << moved.p, logarithm(moved.R);
  for (int i = 0; i < 6; ++i) {
    const auto& free = robot.base_axes;
    const bool fixed = std::find(free.begin(), free.end(), i) == free.end();
    if (!fixed || std::abs(along[i]) <= kRounding) continue;
    const char* name = kTwistAxes[static_cast<std::size_t>(i)];
    theta.throw_bad_value(
        i < 3 ? "position" : "rpy",
        fmt::format("{} = 0 relative to the base's mount, because {} is not among its axes", name,
                    name));
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
  state.base = pose_from_xyz_rpy(position, rpy);
  require_free_axes(theta, state.base, robot);
  state.q.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    state.q[static_cast<Eigen::Index>(i)] = theta.number(robot.joints[i].name);
  }
  state.velocity = read_velocities(root, "velocity", robot);
  state.acceleration = read_velocities(root, "acceleration", robot);
  return state;
}

}  // namespace maxwrench
