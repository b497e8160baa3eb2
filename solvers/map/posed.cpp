#include "solvers/map/posed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lib/math/decompositions.h"
#include "lib/posture/free_pose.h"
#include "lib/robot/chain.h"
#include "lib/scenario/static_load.h"
#include "maxwrench/zonotope.h"
#include "solvers/map/plan_check.h"
#include "solvers/map/robot_keys.h"
#include "solvers/solve/format.h"

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
  task.scenarios.F = basis_across(task.W_any, c);
}

void choose_wrench(long number, Problem& task) {
  ScenarioList& list = task.scenarios;
  list.wrenches = {list.wrenches.at(static_cast<std::size_t>(number - 1))};
  const Vector6d& c = list.wrenches.front().c;
  if (!list.wrenches.front().hold && c.norm() > 0) task.c = c / c.norm();
}

/// Multiplies the limits of some actuators, in each scenario.
void scale_limits(const std::vector<Eigen::Index>& actuators, double factor, Problem& task) {
  const auto scale = [&](Zonotope& set) {
    Eigen::VectorXd u_min = set.u_min, u_max = set.u_max;
    for (const Eigen::Index i : actuators) {
      u_min[i] *= factor;
      u_max[i] *= factor;
    }
    set = with_limits(std::move(set), u_min, u_max);
  };
  scale(task.robot.actuation);
  for (ScenarioLimits& limits : task.scenarios.limits) scale(limits.actuation);
}

/// Sets the wrench of a payload to its weight at the pose.
void set_weight(Problem& task) {
  Vector6d& c = task.scenarios.wrenches.front().c;
  c = payload_wrench(task.robot, *task.scenarios.payload, task.pose.R);
  task.c = c.stableNormalized();
}

}  // namespace

Matrix6Xd basis_across(const Matrix6Xd& W, const Vector6d& c) {
  const Eigen::VectorXd along_c = W.transpose() * c;
  return W * split(along_c).complement;
}

std::vector<Eigen::Index> scaled_actuators(const Robot& robot, const std::string& coordinate) {
  std::vector<Eigen::Index> found;
  const auto thrusters = static_cast<Eigen::Index>(robot.thrusters.size());
  const bool all = coordinate == "thrust" || coordinate == "torque";
  if (!all && is_map_coordinate(coordinate)) return found;
  for (Eigen::Index i = 0; i < robot.actuators(); ++i) {
    const bool such = (coordinate == "thrust") == (i < thrusters);
    if (all ? such : actuator_name(robot, i) == coordinate) found.push_back(i);
  }
  return found;
}

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
    const std::vector<Eigen::Index> scaled = scaled_actuators(task.robot, name);
    if (!scaled.empty()) scale_limits(scaled, value, here);
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
  for (std::size_t a = 0; a < over.size(); ++a) {
    if (!unit_of_robot_key(over[a].name)) continue;
    set_robot_key(over[a].name, at[static_cast<Eigen::Index>(a)], here);
  }
  if (here.scenarios.payload) set_weight(here);
  here.start_system.reset();
  return here;
}

}  // namespace maxwrench
