#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "maxwrench/load.h"
#include "problems/loader/bad_input.h"
#include "problems/loader/block.h"
#include "problems/loader/collision.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

/// `got` must be one of the keys of the map.
template <class Value>
const Value& find_named(const std::map<std::string, Value>& values, const std::string& name,
                        const Block& block, std::string_view key, std::string_view noun) {
  const auto found = values.find(name);
  if (found != values.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : values) names.push_back(entry.first);
  block.refuse_value(key, fmt::format("'{}'", name),
                     fmt::format("{}: {}", noun, fmt::join(names, ", ")));
}

const Body& find_body(const UrdfTree& tree, const Block& block, std::string_view key,
                      const std::string& name) {
  return find_named(tree.bodies, name, block, key, "a link of the URDF");
}

Pose<double> read_placement(const Block& block) {
  return pose_from_xyz_rpy(block.vector("xyz", Eigen::Vector3d::Zero()),
                           block.vector("rpy", Eigen::Vector3d::Zero()));
}

void read_base(const Block& base, const UrdfTree& tree, Robot& robot) {
  base.allow_only({"axes", "link", "xyz", "rpy"});
  std::map<std::string, int> axes;
  for (const char* axis : kTwistAxes) axes.emplace(axis, static_cast<int>(axes.size()));
  for (const std::string& name : base.texts("axes")) {
    robot.base_axes.push_back(find_named(axes, name, base, "axes", "only these axes"));
  }
  auto& free = robot.base_axes;
  std::sort(free.begin(), free.end());
  const bool twice = std::adjacent_find(free.begin(), free.end()) != free.end();
  if (twice || !base_axes_are_integrable(free)) {
    base.refuse_value("axes",
                      "one of [], [x], [x,y], [x,y,z], [yaw], [x,y,yaw], [x,y,z,yaw] or all six "
                      "(others do not integrate to poses)");
  }
  if (base.text("link", tree.root) != tree.root) {
    base.refuse_value("link", fmt::format("the root link '{}' of the URDF", tree.root));
  }
  robot.mount = read_placement(base);
  if (free.size() < 6) return;
  for (const char* key : {"xyz", "rpy"}) {
    if (base.has(key)) base.refuse_value(key, "no such key: a base on all six axes starts nowhere");
  }
}

void read_thrusters(const Block& thrusters, Robot& robot) {
  thrusters.allow_only({"force_min", "force_max", "force_rate_max", "list"});
  std::set<std::string> names;
  for (const Block& block : thrusters.list("list")) {
    block.allow_only({"name", "position", "direction", "force_min", "force_max", "force_rate_max"});
    const auto holder = [&](std::string_view key) { return block.has(key) ? block : thrusters; };
    Thruster thruster;
    thruster.name = block.text("name");
    const bool is_joint =
        std::any_of(robot.joints.begin(), robot.joints.end(),
                    [&](const Joint& joint) { return joint.name == thruster.name; });
    if (is_joint || !names.insert(thruster.name).second) {
      block.refuse_value("name", "a name of its own");
    }
    thruster.position = block.vector("position");
    thruster.direction = block.direction("direction");
    thruster.force_min = holder("force_min").number("force_min");
    thruster.force_max = holder("force_max").number("force_max");
    if (thruster.force_min > thruster.force_max) {
      if (block.has("force_max")) {
        block.refuse_value("force_max", fmt::format("at least force_min = {}", thruster.force_min));
      }
      holder("force_min")
          .refuse_value("force_min", fmt::format("at most force_max = {}", thruster.force_max));
    }
    const Block rate = holder("force_rate_max");
    thruster.force_rate_max = rate.number("force_rate_max", kInfinity);
    if (!(thruster.force_rate_max > 0)) rate.refuse_value("force_rate_max", "a number > 0");
    robot.thrusters.push_back(std::move(thruster));
  }
}

void read_end_effectors(const Block& root, const UrdfTree& tree, Robot& robot) {
  for (const auto& [name, block] : root.named("end_effectors")) {
    block.allow_only({"link", "xyz", "rpy"});
    const Body& body = find_body(tree, block, "link", block.text("link"));
    robot.end_effectors.push_back({name, body.link, body.placement * read_placement(block)});
  }
}

/// Bodies on one link add their volumes; the centre of buoyancy is the weighted mean.
void read_buoyancy(const Block& root, const UrdfTree& tree, Robot& robot) {
  const Block all = root.table("buoyancy");
  for (const auto& [name, block] : root.named("buoyancy")) {
    block.allow_only({"volume", "cob"});
    const Body& body = find_body(tree, all, name, name);
    const double volume = block.number("volume");
    if (volume < 0) block.refuse_value("volume", "a number >= 0");
    const Eigen::Vector3d cob = body.placement.R * block.vector("cob") + body.placement.p;
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

Vector6d coefficients(const Block& block, std::string_view key) {
  const Vector6d values = block.numbers(key, 6);
  if (values.minCoeff() < 0) block.refuse_value(key, "6 numbers >= 0");
  return values;
}

/// Bodies on one link stay apart; only their frames are turned into those of the link.
void read_hydrodynamics(const Block& root, const UrdfTree& tree, Robot& robot) {
  const Block all = root.table("hydrodynamics");
  for (const auto& [name, block] : root.named("hydrodynamics")) {
    block.allow_only({"center", "added_mass", "damping_linear", "damping_quadratic"});
    const Body& body = find_body(tree, all, name, name);
    HydrodynamicBody water;
    water.frame = body.placement;
    water.frame.p += body.placement.R * block.vector("center", Eigen::Vector3d::Zero());
    water.added_mass = coefficients(block, "added_mass");
    water.damping_linear = coefficients(block, "damping_linear");
    water.damping_quadratic = coefficients(block, "damping_quadratic");
    robot.links[static_cast<std::size_t>(body.link)].hydrodynamics.push_back(water);
  }
}

/// What displaces water moves water: once one body has added mass, each body with a volume needs
/// its own, if only zeros. A forgotten one would go unnoticed. Added mass and drag are those of
/// water, so there must be some.
void require_hydrodynamics(const Block& root, const Robot& robot) {
  const Block water = root.table("hydrodynamics");
  const auto known = root.named("hydrodynamics");
  if (known.empty()) return;
  for (const auto& [name, block] : root.named("buoyancy")) {
    if (block.number("volume") == 0 || water.has(name)) continue;
    water.refuse_value(name, "nothing",
                       fmt::format("added mass and drag, perhaps zeros: this body displaces water "
                                   "as '{}' does",
                                   known.front().first));
  }
  if (robot.water_density > 0) return;
  root.table("environment")
      .refuse_value("water_density", fmt::format("{:g}", robot.water_density),
                    fmt::format("a density > 0: '{}' has added mass and drag, which are those "
                                "of water",
                                known.front().first));
}

Shape read_capsule(const Block& block, const UrdfTree& tree) {
  block.allow_only({"link", "p0", "p1", "radius"});
  Shape shape;
  shape.body = block.text("link");
  const Body& body = find_body(tree, block, "link", shape.body);
  shape.link = body.link;
  shape.radius = block.number("radius");
  if (!(shape.radius > 0)) block.refuse_value("radius", "a number > 0");
  const Eigen::Vector3d p0 = block.vector("p0"), p1 = block.vector("p1");
  shape.half_length = (p1 - p0).norm() / 2;
  shape.placement.p = (p0 + p1) / 2;
  if (shape.half_length > 0) {  // its axis is z
    Eigen::Matrix3d& R = shape.placement.R;
    R.col(2) = (p1 - p0).normalized();
    R.col(0) = R.col(2).unitOrthogonal();
    R.col(1) = R.col(2).cross(R.col(0));
  }
  shape.placement = body.placement * shape.placement;
  return shape;
}

void read_collision(const Block& collision, UrdfTree& tree, Robot& robot) {
  collision.allow_only({"margin", "ignore", "capsules"});
  for (const Block& block : collision.list("capsules")) {
    tree.shapes.push_back(read_capsule(block, tree));
  }
  std::vector<std::pair<std::string, std::string>> ignore;
  if (collision.has("ignore")) ignore = collision.text_pairs("ignore");
  for (const auto& [a, b] : ignore) {
    find_body(tree, collision, "ignore", a);
    find_body(tree, collision, "ignore", b);
  }
  for (const Shape& shape : tree.shapes) robot.solids.push_back(to_solid(shape));
  robot.collision =
      make_collision_checker(tree.shapes, ignore, collision.non_negative("margin", 0));
}

}  // namespace

Robot load_robot(const std::filesystem::path& file) {
  const Block root = Block::read(file);
  root.allow_only({"name", "urdf", "base", "environment", "thrusters", "end_effectors", "buoyancy",
                   "hydrodynamics", "trim", "collision"});
  Robot robot;
  robot.name = root.text("name");
  robot.sources = root.sources("robot");
  const std::filesystem::path urdf = file.parent_path() / root.text("urdf");
  if (!is_file(urdf)) {
    root.refuse_value("urdf", fmt::format("a file beside this one ({} is none)", urdf.string()));
  }
  UrdfTree tree = read_urdf(urdf);
  robot.links = tree.links;
  robot.joints = tree.joints;
  read_base(root.table("base"), tree, robot);
  for (std::size_t i = robot.base_axes.empty() ? 1 : 0; i < robot.links.size(); ++i) {
    require_inertia(urdf, robot.links[i]);
  }
  const Block environment = root.table("environment");
  environment.allow_only({"gravity", "water_density"});
  robot.gravity = environment.non_negative("gravity", robot.gravity);
  robot.water_density = environment.non_negative("water_density", robot.water_density);
  read_thrusters(root.table("thrusters"), robot);
  read_end_effectors(root, tree, robot);
  read_buoyancy(root, tree, robot);
  read_hydrodynamics(root, tree, robot);
  require_hydrodynamics(root, robot);
  read_trim(root, robot);
  read_collision(root.table("collision"), tree, robot);
  complete_actuation(robot);
  return robot;
}

}  // namespace maxwrench
