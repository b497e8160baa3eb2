#include "solvers/map/robot_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "lib/scenario/current_load.h"
#include "solvers/map/list_keys.h"
#include "solvers/map/posed.h"

namespace maxwrench {
namespace {

constexpr const char *kGravityKey = "environment.gravity",
                     *kDensityKey = "environment.water_density", *kTrimKey = "trim.buoyancy_mass",
                     *kCarriedKey = "payload.mass";
constexpr std::array<const char*, 3> kCurrentKeys = {
    "environment.current.x", "environment.current.y", "environment.current.z"};
constexpr double kFastestCurrent = 100;  // [m/s]

/// The body of links.NAME.mass; empty: it is another key.
std::string body_of_key(const std::string& key) {
  constexpr std::string_view kLinks = "links.", kMass = ".mass";
  if (!key.starts_with(kLinks) || !key.ends_with(kMass)) return "";
  if (key.size() <= kLinks.size() + kMass.size()) return "";
  return key.substr(kLinks.size(), key.size() - kLinks.size() - kMass.size());
}

/// The component of the current, from 0; nothing: it is another key.
std::optional<Eigen::Index> axis_of_current(const std::string& key) {
  const auto axis = std::find(kCurrentKeys.begin(), kCurrentKeys.end(), key);
  if (axis == kCurrentKeys.end()) return std::nullopt;
  return axis - kCurrentKeys.begin();
}

/// Whether the uncertain loads of a group have a key of this beginning.
bool is_about(const LoadGroup& cases, const std::string& key) {
  return std::any_of(cases.begin(), cases.end(), [&key](const LoadCase& load) {
    return std::any_of(load.deltas.begin(), load.deltas.end(),
                       [&key](const Delta& delta) { return delta.key.starts_with(key); });
  });
}

bool is_uncertain(const ScenarioList& list, const std::string& key) {
  return std::any_of(list.loads.begin(), list.loads.end(),
                     [&key](const LoadGroup& cases) { return is_about(cases, key); });
}

bool has_hydrodynamics(const Robot& robot) {
  return std::any_of(robot.links.begin(), robot.links.end(),
                     [](const Link& link) { return !link.hydrodynamics.empty(); });
}

std::optional<std::string> fault_of_density(const Problem& task, const MapAxis& axis) {
  if (task.scenarios.payload) return "another coordinate: the payload is heavier in other water";
  if (axis.low < 0) return "densities of at least 0";
  if (axis.low == 0 && has_hydrodynamics(task.robot)) {
    return "densities above 0: the robot has added mass and drag, which are those of water";
  }
  return std::nullopt;
}

std::optional<std::string> fault_of_current(const Problem& task, const MapAxis& axis) {
  const ScenarioList& list = task.scenarios;
  if (!has_hydrodynamics(task.robot)) return "another coordinate: the robot has no hydrodynamics";
  if (task.contact) return "another coordinate: the task has a second contact";
  if (std::any_of(list.loads.begin(), list.loads.end(),
                  [](const LoadGroup& cases) { return cases.size() > 1 && has_current(cases); })) {
    return "another coordinate: the current of the task is uncertain";
  }
  if (list.payload && !has_current(list)) return "another coordinate: the task has a payload";
  if (std::max(std::abs(axis.low), std::abs(axis.high)) <= kFastestCurrent) return std::nullopt;
  return fmt::format("currents of at most {:g} m/s", kFastestCurrent);
}

std::optional<std::string> fault_of_mass(const Problem& task, const MapAxis& axis) {
  const std::string body = body_of_key(axis.name);
  std::vector<std::string> names;
  for (const BodyPart& part : task.robot.parts) names.push_back(part.name);
  if (std::find(names.begin(), names.end(), body) == names.end()) {
    return fmt::format("the mass of one of the bodies {}", fmt::join(names, ", "));
  }
  // Widths may be shares of the mass, and the moment of an uncertain centre grows with it.
  for (const char* key : {"mass.", "com."}) {
    if (is_uncertain(task.scenarios, key + body)) {
      return "another coordinate: this body is uncertain in the task";
    }
  }
  if (axis.low < 0) return "masses of at least 0";
  return std::nullopt;
}

/// Gives a body another mass at its centre. Its inertia about that centre stays.
void set_mass(const std::string& body, double mass, Robot& robot) {
  const auto part = std::find_if(robot.parts.begin(), robot.parts.end(),
                                 [&body](const BodyPart& each) { return each.name == body; });
  Link& link = robot.links[static_cast<std::size_t>(part->link)];
  const double change = mass - part->mass;
  part->mass = mass;
  if (link.mass + change > 0) {
    const Eigen::Vector3d com = part->frame.R * part->com + part->frame.p;
    add_body(link, change, com, Eigen::Matrix3d::Zero());
  } else {
    link.mass = 0;
  }
}

void set_density(double density, Problem& task) {
  const double ratio = density / task.robot.water_density;
  for (LoadGroup& cases : task.scenarios.loads) {
    if (!is_about(cases, "volume.") && !is_about(cases, "cob.")) continue;
    for (LoadCase& load : cases) {
      for (LinkLoad& each : load.loads) {
        each.mass *= ratio;
        each.moment *= ratio;
      }
    }
  }
  task.robot.water_density = density;
}

/// Makes a list of the one wrench of a task that has none.
void ensure_list(Problem& task) {
  ScenarioList& list = task.scenarios;
  if (!list.empty()) return;
  list.unit = task.unit();
  list.wrenches = {{.name = "", .c = task.c}};
  list.F = basis_across(task.W_any, task.c);
  list.limits = {{"", task.robot.actuation}};
}

/// Sets a component of the known current, the load of a single case.
void set_current(Eigen::Index axis, double speed, Problem& task) {
  task.robot.current[axis] = speed;
  std::vector<LoadGroup>& loads = task.scenarios.loads;
  std::erase_if(loads, [](const LoadGroup& cases) { return has_current(cases); });
  if (task.robot.current.isZero(0)) return;
  ensure_list(task);
  loads.push_back({{.name = "", .loads = {}, .current = task.robot.current}});
}

/// Adds a point at the origin of the end effector.
void set_carried(double mass, Problem& task) {
  if (mass == 0) return;
  const EndEffector& tip = task.robot.end_effectors[static_cast<std::size_t>(task.end_effector)];
  add_body(task.robot.links[static_cast<std::size_t>(tip.link)], mass, tip.placement.p,
           Eigen::Matrix3d::Zero());
  task.robot.parts.push_back(
      {.name = kCarriedKey, .link = tip.link, .frame = tip.placement, .mass = mass});
}

}  // namespace

const std::vector<std::string>& robot_keys() {
  static const std::vector<std::string> kKeys = {kGravityKey,     kDensityKey,     kCurrentKeys[0],
                                                 kCurrentKeys[1], kCurrentKeys[2], kTrimKey,
                                                 kCarriedKey,     kRadiusKey};
  return kKeys;
}

std::optional<const char*> unit_of_robot_key(const std::string& coordinate) {
  if (coordinate == kGravityKey) return "m/s^2";
  if (coordinate == kDensityKey) return "kg/m^3";
  if (axis_of_current(coordinate)) return "m/s";
  const bool mass = coordinate == kTrimKey || coordinate == kCarriedKey;
  if (mass || !body_of_key(coordinate).empty()) return "kg";
  return unit_of_list_key(coordinate);
}

std::optional<std::string> fault_of_robot_key(const Problem& task, const MapAxis& axis) {
  if (unit_of_list_key(axis.name)) return fault_of_list_key(task, axis);
  if (axis.name == kDensityKey) return fault_of_density(task, axis);
  if (axis_of_current(axis.name)) return fault_of_current(task, axis);
  if (!body_of_key(axis.name).empty()) return fault_of_mass(task, axis);
  const bool weighs = task.scenarios.payload.has_value();
  if (axis.name == kGravityKey) {
    if (weighs && axis.low <= 0) return "values above 0: the weight of the payload is the wrench";
    if (axis.low < 0) return "values of at least 0";
  }
  if (axis.name == kCarriedKey) {
    if (weighs) return "another coordinate: the value of the task is the mass of its payload";
    if (axis.low < 0) return "masses of at least 0";
  }
  return std::nullopt;
}

void set_robot_key(const std::string& key, double value, Problem& task) {
  if (unit_of_list_key(key)) {
    set_list_key(key, value, task);
  } else if (key == kGravityKey) {
    task.robot.gravity = value;
  } else if (key == kDensityKey) {
    set_density(value, task);
  } else if (key == kTrimKey) {
    task.robot.trim.buoyancy_mass = value;
  } else if (key == kCarriedKey) {
    set_carried(value, task);
  } else if (const auto axis = axis_of_current(key)) {
    set_current(*axis, value, task);
  } else {
    set_mass(body_of_key(key), value, task.robot);
  }
}

}  // namespace maxwrench
