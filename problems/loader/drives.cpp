#include "problems/loader/drives.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/robot/brakes.h"
#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

/// The pose of a link that does not move in the base.
Pose<double> fixed_pose(const Block& block, const UrdfTree& tree) {
  if (!block.has("link")) return {};
  const Body& body = find_body(tree, block, "link", block.text("link"));
  if (body.link == 0) return body.placement;
  block.throw_bad_value("link", "a link that is fixed to the base");
}

/// What a wheel can exert, in its own frame: x rolls, y is its axle.
void add_wheel(const Block& block, const Block& wheels, const Pose<double>& frame, Robot& robot) {
  const auto holder = [&](std::string_view key) { return block.has(key) ? block : wheels; };
  const auto positive = [&](std::string_view key) {
    const Block from = holder(key);
    const double value = from.number(key);
    if (!(value > 0)) from.throw_bad_value(key, "a number > 0");
    return value;
  };
  const std::string kind = holder("kind").text("kind");
  const bool mecanum = kind == "mecanum", plain = kind == "plain";
  if (!mecanum && !plain && kind != "omni") {
    holder("kind").throw_bad_value("kind", "'mecanum', 'omni' or 'plain'");
  }
  const double friction = positive("mu") * positive("load"), motor = positive("force");
  const std::string name = block.text("name");
  const Eigen::Vector3d position =
      frame.R * block.vector("position", Eigen::Vector3d::Zero()) + frame.p;
  const double heading = block.number("heading", 0);
  const auto add = [&](const std::string& force, double angle, double limit) {
    const Eigen::Vector3d along(std::cos(heading + angle), std::sin(heading + angle), 0);
    robot.thrusters.push_back({.name = force,
                               .position = position,
                               .direction = frame.R * along,
                               .force_min = -limit,
                               .force_max = limit});
  };
  double roller = 0;
  if (mecanum) {
    roller = holder("roller").number("roller");
    if (!(std::abs(roller) < std::numbers::pi / 2)) {
      holder("roller").throw_bad_value("roller", "an angle within -pi/2 .. pi/2, often 0.785");
    }
  }
  add(name, roller, std::min(motor / std::cos(roller), friction));
  if (plain) add(name + "_side", std::numbers::pi / 2, friction);
}

/// Sets the limits of the thruster or motor of this name, or of all thrusters for `thrusters`.
void set_limit(const Block& block, const std::string& name, Robot& robot) {
  const double limit = block.number(name);
  if (!(limit >= 0)) block.throw_bad_value(name, "a number >= 0");
  bool known = false;
  for (Thruster& thruster : robot.thrusters) {
    if (name != "thrusters" && name != thruster.name) continue;
    thruster.force_min = -limit;
    thruster.force_max = limit;
    known = true;
  }
  for (Joint& joint : robot.joints) {
    if (name != joint.name || joint.gear) continue;
    joint.effort_max = limit;
    known = true;
  }
  if (known) return;
  std::vector<std::string> names;
  for (const Thruster& thruster : robot.thrusters) names.push_back(thruster.name);
  for (const Joint& joint : robot.joints) {
    if (!joint.gear) names.push_back(joint.name);
  }
  block.throw_bad_value(
      name, fmt::format("a thruster or a joint with a motor: {}", fmt::join(names, ", ")));
}

}  // namespace

const Body& find_body(const UrdfTree& tree, const Block& block, std::string_view key,
                      const std::string& name) {
  const auto found = tree.bodies.find(name);
  if (found != tree.bodies.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : tree.bodies) names.push_back(entry.first);
  block.throw_bad_value(key, fmt::format("'{}'", name),
                        fmt::format("a link of the URDF: {}", fmt::join(names, ", ")));
}

void read_thrusters(const Block& thrusters, const UrdfTree& tree, Robot& robot) {
  thrusters.allow_only({"force_min", "force_max", "force_rate_max", "list"});
  for (const Block& block : thrusters.list("list")) {
    block.allow_only(
        {"name", "link", "position", "direction", "force_min", "force_max", "force_rate_max"});
    const auto holder = [&](std::string_view key) { return block.has(key) ? block : thrusters; };
    const bool placed = block.has("link");
    const Pose<double> frame = fixed_pose(block, tree);
    const auto vector = [&](std::string_view key, const Eigen::Vector3d& of_link) {
      return placed ? block.vector(key, of_link) : block.vector(key);
    };
    robot.thrusters.push_back(
        {.name = block.text("name"),
         .position = frame.R * vector("position", Eigen::Vector3d::Zero()) + frame.p,
         .direction = frame.R * vector("direction", Eigen::Vector3d::UnitX()),
         .force_min = holder("force_min").number("force_min"),
         .force_max = holder("force_max").number("force_max"),
         .force_rate_max = holder("force_rate_max").number("force_rate_max", kInfinity)});
  }
}

void read_wheels(const Block& wheels, const UrdfTree& tree, Robot& robot) {
  wheels.allow_only({"kind", "force", "mu", "load", "roller", "list"});
  for (const Block& block : wheels.list("list")) {
    block.allow_only(
        {"name", "kind", "link", "position", "heading", "force", "mu", "load", "roller"});
    add_wheel(block, wheels, fixed_pose(block, tree), robot);
  }
}

void read_limits(const Block& root, const std::string& chosen, Robot& robot) {
  std::vector<std::string> names;
  for (const auto& [name, block] : root.named("limits")) {
    names.push_back(name);
    Robot limited = robot;
    // One number for all thrusters, then those of their own.
    if (block.has("thrusters")) set_limit(block, "thrusters", limited);
    for (const auto& entry : block.numbers_by_name()) {
      if (entry.first != "thrusters") set_limit(block, entry.first, limited);
    }
    if (name != chosen) continue;
    limited.limits = name;
    std::swap(robot, limited);
  }
  if (!names.empty()) robot.notes.push_back(fmt::format("limits: {}", fmt::join(names, ", ")));
  if (robot.limits == chosen) return;
  throw BadValue("limits", shown(chosen),
                 names.empty() ? "none: the robot has no table of that kind"
                               : fmt::format("one of {}", fmt::join(names, ", ")));
}

void add_brakes(Robot& robot) {
  constexpr double kArm = 1;  // m
  const auto add = [&](const std::string& name, const Eigen::Vector3d& position,
                       const Eigen::Vector3d& direction) {
    robot.thrusters.push_back({.name = "brake_" + name,
                               .position = position,
                               .direction = direction,
                               .force_min = -kBrakeForce,
                               .force_max = kBrakeForce});
  };
  for (const int axis : robot.base_axes) {
    const std::string name = kTwistAxes[static_cast<std::size_t>(axis)];
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis % 3);
    if (axis < 3) {
      add(name, Eigen::Vector3d::Zero(), unit);
    } else {
      // A force beside the axis; the brakes of the translations carry the force itself.
      add(name, kArm * Eigen::Vector3d::Unit((axis + 1) % 3),
          Eigen::Vector3d::Unit((axis + 2) % 3));
    }
  }
}

}  // namespace maxwrench
