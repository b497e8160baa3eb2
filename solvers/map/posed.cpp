#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/posture/free_pose.h"
#include "maxwrench/map.h"

namespace maxwrench {
namespace {

/// Part of a unit direction outside a space that is not rounding.
constexpr double kOutside = 1e-9;

/// X_0 Trans(x, y, z) Rz(yaw) Ry(pitch) Rx(roll), as the pose of a task with all coordinates free.
Pose<double> moved(const Pose<double>& pose, const Vector6d& offset) {
  Problem all_free;
  all_free.pose = pose;
  all_free.free.axes = {0, 1, 2, 3, 4, 5};
  return pose_at(all_free, offset);
}

/// Replaces c. The allowed wrenches stay, and must contain it.
void set_direction(const Eigen::Vector3d& direction, Problem& task) {
  Vector6d c = Vector6d::Zero();
  const bool force = task.c.head<3>().norm() > task.c.tail<3>().norm();
  (force ? c.head<3>() : c.tail<3>()) = task.wrench_axes * direction;
  const Vector6d outside = c - task.W_any * (task.W_any.transpose() * c);
  if (outside.norm() > kOutside) {
    throw std::invalid_argument(
        fmt::format("over: got the direction [{:.3g}, {:.3g}, {:.3g}], expected directions within "
                    "the wrenches that do work and that wrench.any allows ({})",
                    direction.x(), direction.y(), direction.z(), task.name));
  }
  task.c = c;
  if (task.scenarios.empty()) return;
  ScenarioWrench& wrench = task.scenarios.wrenches.front();
  wrench.c = wrench.c.norm() * c;
  const Eigen::VectorXd along_c = task.W_any.transpose() * c;
  task.scenarios.F = task.W_any * split(along_c).complement;
}

void choose_wrench(long number, Problem& task) {
  ScenarioList& list = task.scenarios;
  list.wrenches = {list.wrenches.at(static_cast<std::size_t>(number - 1))};
  const Vector6d& c = list.wrenches.front().c;
  if (!list.wrenches.front().hold && c.norm() > 0) task.c = c / c.norm();
}

}  // namespace

Problem posed(const Problem& task, const std::vector<MapAxis>& over, const Eigen::VectorXd& at) {
  Problem here = task;
  Vector6d offset = Vector6d::Zero();
  std::optional<double> azimuth, elevation;
  for (std::size_t a = 0; a < over.size(); ++a) {
    const double value = at[static_cast<Eigen::Index>(a)];
    const std::string& name = over[a].name;
    if (name == "azimuth") azimuth = value;
    if (name == "elevation") elevation = value;
    if (name == "wrench") choose_wrench(std::lround(value), here);
    for (std::size_t axis = 0; axis < kTwistAxes.size(); ++axis) {
      if (name == kTwistAxes[axis]) offset[static_cast<Eigen::Index>(axis)] = value;
    }
  }
  here.pose = moved(task.pose, offset);
  if (task.wrench_in_end_effector) {
    turn_wrenches(here.pose.R * task.pose.R.transpose(), here);
  }
  if (azimuth || elevation) {
    const double a = azimuth.value_or(0), e = elevation.value_or(0);
    set_direction({std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)}, here);
  }
  here.start_system.reset();
  return here;
}

}  // namespace maxwrench
