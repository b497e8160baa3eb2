#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
#include "problems/loader/drives.h"
#include "problems/loader/robot_choices.h"
#include "problems/loader/robot_srdf.h"
#include "problems/loader/urdf_tree.h"
#include "problems/make/posture.h"
#include "problems/make/robot.h"

namespace maxwrench {
namespace {

/// The value of this name. Rejects a name that is not a key of the map.
template <class Value>
const Value& find_named(const std::map<std::string, Value>& values, const std::string& name,
                        const Block& block, std::string_view key, std::string_view noun) {
  const auto found = values.find(name);
  if (found != values.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : values) names.push_back(entry.first);
  block.throw_bad_value(key, fmt::format("'{}'", name),
                        fmt::format("{}: {}", noun, fmt::join(names, ", ")));
}

Pose<double> read_placement(const Block& block) {
  return pose_from_xyz_rpy(block.vector("xyz", Eigen::Vector3d::Zero()),
                           block.vector("rpy", Eigen::Vector3d::Zero()));
}

void read_base(const Block& base, const UrdfTree& tree, Robot& robot) {
  base.allow_only({"axes", "link", "xyz", "rpy", "parked"});
  std::map<std::string, int> axes;
  for (const char* axis : kTwistAxes) axes.emplace(axis, static_cast<int>(axes.size()));
  for (const std::string& name : base.texts("axes")) {
    robot.base_axes.push_back(find_named(axes, name, base, "axes", "only these axes"));
  }
  if (base.text("link", tree.root) != tree.root) {
    base.throw_bad_value("link", fmt::format("the root link '{}' of the URDF", tree.root));
  }
  robot.mount = read_placement(base);
  if (robot.base_axes.size() < 6) return;
  for (const char* key : {"xyz", "rpy"}) {
    if (base.has(key))
      base.throw_bad_value(key, "no such key: a base on all six axes needs no start");
  }
}

void read_end_effectors(const Block& root, const UrdfTree& tree, Robot& robot) {
  for (const auto& [name, block] : root.named("end_effectors")) {
    block.allow_only({"link", "xyz", "rpy"});
    const Body& body = find_body(tree, block, "link", block.text("link"));
    robot.end_effectors.push_back({name, body.link, body.placement * read_placement(block)});
  }
  if (!robot.end_effectors.empty()) return;
  for (const std::string& name : tree.group_tips) {
    const Body& body = tree.bodies.at(name);
    robot.end_effectors.push_back({name, body.link, body.placement});
  }
}

BodyPart& part_named(const std::string& name, Robot& robot) {
  return *std::find_if(robot.parts.begin(), robot.parts.end(),
                       [&name](const BodyPart& part) { return part.name == name; });
}

/// The volumes of bodies on one link are added; the centre of buoyancy is their weighted mean.
void read_buoyancy(const Block& root, const UrdfTree& tree, Robot& robot) {
  const Block all = root.table("buoyancy");
  for (const auto& [name, block] : root.named("buoyancy")) {
    block.allow_only({"volume", "cob"});
    const Body& body = find_body(tree, all, name, name);
    const double volume = block.number("volume");
    require_non_negative(fmt::format("buoyancy.{}.volume", name), volume);
    BodyPart& part = part_named(name, robot);
    part.volume = volume;
    part.cob = block.vector("cob");
    const Eigen::Vector3d cob = body.placement.R * part.cob + body.placement.p;
    Link& link = robot.links[static_cast<std::size_t>(body.link)];
    link.volume += volume;
    if (volume > 0) link.cob += volume / link.volume * (cob - link.cob);
  }
}

void read_trim(const Block& root, Robot& robot) {
  if (!root.has("trim")) return;
  const Block trim = root.table("trim");
  trim.allow_only({"buoyancy_mass", "position"});
  robot.trim = {trim.number("buoyancy_mass"), trim.vector("position")};
}

/// Bodies on one link stay separate; only their frames are converted to those of the link.
void read_hydrodynamics(const Block& root, const UrdfTree& tree, Robot& robot) {
  const Block all = root.table("hydrodynamics");
  for (const auto& [name, block] : root.named("hydrodynamics")) {
    block.allow_only({"center", "added_mass", "damping_linear", "damping_quadratic"});
    const Body& body = find_body(tree, all, name, name);
    const auto coefficients = [&name = name, &block = block](std::string_view key) {
      const Vector6d values = block.numbers(key, 6);
      require_coefficients(fmt::format("hydrodynamics.{}.{}", name, key), values);
      return values;
    };
    HydrodynamicBody water;
    water.frame = body.placement;
    water.frame.p += body.placement.R * block.vector("center", Eigen::Vector3d::Zero());
    water.added_mass = coefficients("added_mass");
    water.damping_linear = coefficients("damping_linear");
    water.damping_quadratic = coefficients("damping_quadratic");
    robot.links[static_cast<std::size_t>(body.link)].hydrodynamics.push_back(water);
  }
}

/// Checks body by body. The robot itself only knows links, each of which may contain several
/// bodies.
void require_water(const Block& root, const Robot& robot) {
  std::vector<InWater> bodies;
  for (const auto& [name, block] : root.named("hydrodynamics")) bodies.push_back({name, 0, true});
  const Block known = root.table("hydrodynamics");
  for (const auto& [name, block] : root.named("buoyancy")) {
    bodies.push_back({name, block.number("volume"), known.has(name)});
  }
  require_hydrodynamics(bodies, robot.water_density);
}

Shape read_capsule(const Block& block, const UrdfTree& tree) {
  block.allow_only({"link", "p0", "p1", "radius"});
  Shape shape;
  shape.body = block.text("link");
  const Body& body = find_body(tree, block, "link", shape.body);
  shape.link = body.link;
  shape.radius = block.number("radius");
  if (!(shape.radius > 0)) block.throw_bad_value("radius", "a number > 0");
  const Eigen::Vector3d p0 = block.vector("p0"), p1 = block.vector("p1");
  shape.half_length = (p1 - p0).norm() / 2;
  shape.placement.p = (p0 + p1) / 2;
  if (shape.half_length > 0) {  // the axis of the shape is z
    Eigen::Matrix3d& R = shape.placement.R;
    R.col(2) = (p1 - p0).normalized();
    R.col(0) = R.col(2).unitOrthogonal();
    R.col(1) = R.col(2).cross(R.col(0));
  }
  shape.placement = body.placement * shape.placement;
  return shape;
}

/// A body without a shape cannot collide, and the robot does not know it.
void drop_pairs_without_shapes(Collision& collision) {
  const auto has_shape = [&collision](const std::string& body) {
    return std::any_of(collision.shapes.begin(), collision.shapes.end(),
                       [&body](const Shape& shape) { return shape.body == body; });
  };
  std::erase_if(collision.ignore, [&](const auto& pair) {
    return !has_shape(pair.first) || !has_shape(pair.second);
  });
}

/// @param more  pairs that an SRDF leaves out
Collision read_collision(const Block& block, const UrdfTree& tree, const LinkPairs& more) {
  block.allow_only({"margin", "ignore", "capsules", "meshes"});
  Collision collision;
  collision.shapes = tree.shapes;
  for (const Block& capsule : block.list("capsules")) {
    collision.shapes.push_back(read_capsule(capsule, tree));
  }
  // Whoever lists pairs lists all of them.
  collision.find_ignored = !block.has("ignore");
  if (block.has("ignore")) collision.ignore = block.text_pairs("ignore");
  for (const auto& [a, b] : collision.ignore) {
    find_body(tree, block, "ignore", a);
    find_body(tree, block, "ignore", b);
  }
  collision.ignore.insert(collision.ignore.end(), more.begin(), more.end());
  drop_pairs_without_shapes(collision);
  collision.margin = block.number("margin", 0);
  return collision;
}

/// Named postures of the TOML, which count more than those of an SRDF.
void read_states(const Block& root, Robot& robot) {
  for (const auto& [name, block] : root.named("states")) {
    robot.states[name] = block.numbers_by_name();
    for (const auto& [joint, position] : robot.states[name]) {
      if (find_joint(robot, joint) < 0) block.throw_bad_value(joint, "a joint that moves");
    }
  }
}

std::filesystem::path named_file(const Block& root, const char* key) {
  const std::filesystem::path path = root.file().parent_path() / root.text(key);
  if (is_file(path)) return path;
  root.throw_bad_value(
      key, fmt::format("a file relative to this one ({} is not a file)", path.string()));
}

void add_tree(const UrdfTree& tree, Robot& robot) {
  robot.links = tree.links;
  robot.parts = tree.parts;
  robot.joints = tree.joints;
  robot.warnings = tree.warnings;
  robot.notes = tree.notes;
  robot.no_dynamics = tree.no_dynamics;
  robot.files.insert(robot.files.end(), tree.files.begin(), tree.files.end());
}

/// The key of a thruster's value. If the thruster has no value of its own, the key is that of the
/// value that all thrusters share.
std::string thruster_key(const Block& thrusters, const std::string& key) {
  const std::vector<Block> list = thrusters.list("list");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string own = fmt::format("thrusters.list[{}].", i);
    if (!key.starts_with(own)) continue;
    const std::string name = key.substr(own.size());
    return list[i].has(name) ? key : "thrusters." + name;
  }
  return key;
}

void require_group_for_rest(const UrdfOptions& options) {
  if (!options.group.empty() || (options.rest_posture.empty() && options.rest.empty())) return;
  throw BadValue("rest",
                 shown(options.rest.empty() ? options.rest_posture : options.rest.begin()->first),
                 "none without a group");
}

/// Rejects positions of joints that neither move nor stay where they are told.
void require_joints(std::map<std::string, double> positions, const UrdfTree& tree,
                    const Robot& robot) {
  std::erase_if(positions, [&](const auto& each) { return tree.undriven.contains(each.first); });
  joints_by_name("pose.joints.", positions, robot);
}

}  // namespace

Robot load_robot(const std::filesystem::path& file, const LoadOptions& options) {
  const Block root = Block::read(file);
  root.allow_only({"name", "urdf", "srdf", "group", "group_rest", "packages", "base", "environment",
                   "thrusters", "wheels", "joints", "links", "limits", "states", "end_effectors",
                   "buoyancy", "hydrodynamics", "trim", "collision"});
  Robot robot;
  robot.name = root.text("name");
  robot.sources = root.sources("robot");
  robot.files.push_back(file.string());
  const std::filesystem::path urdf = named_file(root, "urdf");
  const Block thrusters = root.table("thrusters");
  const auto file_of = [&](std::string& key) {
    if (key.starts_with("link[") || key.starts_with("joint[")) return urdf;
    key = thruster_key(thrusters, key);
    return file;
  };
  return in_files(file_of, [&] {
    UrdfChoices choices = read_choices(root);
    const RobotSrdf srdf(root.has("srdf") ? named_file(root, "srdf") : std::filesystem::path());
    if (root.has("group_rest") && !root.has("group")) {
      root.throw_bad_value("group_rest", "no such key without group");
    }
    srdf.choose_group("group", root.text("group", ""), "group_rest", root.text("group_rest", ""),
                      choices);
    const UrdfTree tree = read_urdf(urdf, choices);
    add_tree(tree, robot);
    srdf.add_to(tree, robot);
    if (root.has("base")) read_base(root.table("base"), tree, robot);
    const Block environment = root.table("environment");
    environment.allow_only({"gravity", "water_density", "current"});
    robot.gravity = environment.number("gravity", robot.gravity);
    robot.water_density = environment.number("water_density", robot.water_density);
    robot.current = environment.vector("current", robot.current);
    read_thrusters(thrusters, tree, robot);
    read_wheels(root.table("wheels"), tree, robot);
    read_limits(root, options.limits, robot);
    if (root.table("base").truth("parked", false)) add_brakes(robot);
    read_end_effectors(root, tree, robot);
    read_buoyancy(root, tree, robot);
    read_hydrodynamics(root, tree, robot);
    require_water(root, robot);
    read_trim(root, robot);
    read_states(root, robot);
    return finalize(robot, read_collision(root.table("collision"), tree, srdf.ignored_pairs()));
  });
}

Robot load_urdf(const std::filesystem::path& urdf, const UrdfOptions& options) {
  const auto file_of = [&](const std::string&) { return urdf; };
  return in_files(file_of, [&] {
    UrdfChoices choices;
    choices.packages = options.packages;
    if (!options.tool.empty() && options.locks_undriven) choices.tips = {options.tool};
    const RobotSrdf srdf(options.srdf);
    require_group_for_rest(options);
    srdf.choose_group("group", options.group, options.rest_posture.empty() ? "posture" : "rest",
                      options.rest_posture.empty() ? options.posture : options.rest_posture,
                      choices);
    if (choices.group) choices.group->rest = options.rest;
    choices.positions = srdf.posture(options.posture);
    for (const auto& [joint, position] : options.positions) choices.positions[joint] = position;
    const UrdfTree tree = read_urdf(urdf, choices);
    Robot robot;
    robot.name = tree.name;
    add_tree(tree, robot);
    require_joints(options.positions, tree, robot);
    const auto add_tool = [&](const std::string& name) {
      const Body& body = tree.bodies.at(name);
      robot.end_effectors.push_back({name, body.link, body.placement});
    };
    if (options.tool.empty()) {
      for (const std::string& name : choices.group ? tree.group_tips : tree.leaves) add_tool(name);
    } else if (tree.bodies.contains(options.tool)) {
      add_tool(options.tool);
    } else {
      throw BadValue(
          "tool", shown(options.tool),
          fmt::format("a link of the URDF, for example {}", fmt::join(tree.leaves, ", ")));
    }
    robot.base_axes = options.base_axes;
    add_brakes(robot);
    Collision collision;
    collision.shapes = tree.shapes;
    collision.find_ignored = true;
    srdf.add_to(tree, robot);
    collision.ignore = srdf.ignored_pairs();
    drop_pairs_without_shapes(collision);
    return finalize(robot, collision);
  });
}

}  // namespace maxwrench
