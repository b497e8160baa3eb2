#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>

#include "maxwrench/task.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/part_values.h"
#include "python/src/parts.h"
#include "python/src/words.h"

// Robots that are made in code. Wrong values are named by the keys of robot files.

namespace maxwrench::python {
namespace {

template <class Named>
std::vector<std::string> part_names(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& each : all) names.push_back(each.name);
  return names;
}

/// The index of a link or joint that is given by its name or its index, which is checked later.
int index_in(const std::string& key, const py::object& value, const char* noun,
             const std::vector<std::string>& names) {
  if (!py::isinstance<py::str>(value)) return integer_in(key, value);
  const std::string name = value.cast<std::string>();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw BadValue(key, shown(name), fmt::format("a {}: {}", noun, fmt::join(names, ", ")));
  }
  return static_cast<int>(found - names.begin());
}

/// A matrix of inertia, or its diagonal.
Eigen::Matrix3d inertia_in(const std::string& key, const py::object& value) {
  const Array array = numbers(key, value);
  if (array.ndim() == 1) return Eigen::Vector3d(vector(key, array, 3)).asDiagonal();
  return matrix(key, array, 3, 3);
}

HydrodynamicBody make_body(const std::string& key, const py::handle& object) {
  const Part part(key, object, "Hydrodynamics");
  return {part.pose(key, "frame"), part.numbers(key + ".added_mass", "added_mass", 6),
          part.numbers(key + ".damping_linear", "damping_linear", 6),
          part.numbers(key + ".damping_quadratic", "damping_quadratic", 6)};
}

Link make_link(const std::string& key, const py::handle& object) {
  const Part part(key, object, "Link");
  Link link;
  link.name = part.text(key + ".name", "name");
  const std::string inertial = fmt::format("link[{}].inertial.", link.name);
  link.mass = part.number(inertial + "mass", "mass");
  link.com = part.numbers(inertial + "origin.xyz", "com", 3);
  link.inertia = inertia_in(inertial + "inertia", part.get("inertia"));
  link.volume = part.number(fmt::format("buoyancy.{}.volume", link.name), "volume");
  link.cob = part.numbers(fmt::format("buoyancy.{}.cob", link.name), "cob", 3);
  link.hydrodynamics = parts_in<HydrodynamicBody>(fmt::format("hydrodynamics.{}", link.name),
                                                  part.get("hydrodynamics"),
                                                  "a list of maxwrench.Hydrodynamics", &make_body);
  return link;
}

JointType joint_type_in(const std::string& key, const std::string& name) {
  if (name == "revolute") return JointType::kRevolute;
  if (name == "prismatic") return JointType::kPrismatic;
  throw BadValue(key, shown(name), "revolute or prismatic");
}

Joint make_joint(const std::string& key, const py::handle& object,
                 const std::vector<std::string>& links) {
  const Part part(key, object, "Joint");
  Joint joint;
  joint.name = part.text(key + ".name", "name");
  const std::string own = fmt::format("joint[{}].", joint.name);
  joint.type = joint_type_in(own + "type", part.text(own + "type", "type"));
  joint.parent = index_in(own + "parent", part.get("parent"), "link", links);
  joint.placement = part.pose(own + "origin", "placement");
  joint.axis = part.numbers(own + "axis.xyz", "axis", 3);
  joint.q_min = part.number(own + "limit.lower", "q_min");
  joint.q_max = part.number(own + "limit.upper", "q_max");
  joint.velocity_max = part.number(own + "limit.velocity", "velocity_max");
  joint.effort_max = part.number(own + "limit.effort", "effort_max");
  return joint;
}

/// The gears, which name joints.
void set_gears(const py::object& objects, std::vector<Joint>& joints) {
  const std::vector<std::string> names = part_names(joints);
  std::size_t i = 0;
  for (const py::handle& object : objects) {
    Joint& joint = joints[i++];
    const py::object given = object.attr("gear");
    if (given.is_none()) continue;
    const std::string key = fmt::format("joint[{}].mimic", joint.name);
    const Part part(key, given, "Gear");
    joint.gear =
        Gear{index_in(key + ".joint", part.get("leader"), "joint", names),
             part.number(key + ".multiplier", "ratio"), part.number(key + ".offset", "offset")};
  }
}

Thruster make_thruster(const std::string& key, const py::handle& object) {
  const Part part(key, object, "Thruster");
  return {part.text(key + ".name", "name"),
          part.numbers(key + ".position", "position", 3),
          part.numbers(key + ".direction", "direction", 3),
          part.number(key + ".force_min", "force_min"),
          part.number(key + ".force_max", "force_max"),
          part.number(key + ".force_rate_max", "force_rate_max")};
}

EndEffector make_end_effector(const std::string& key, const py::handle& object,
                              const std::vector<std::string>& links) {
  const Part part(key, object, "EndEffector");
  const std::string name = part.text(key + ".name", "name");
  const std::string own = "end_effectors." + name;
  return {name, index_in(own + ".link", part.get("link"), "link", links),
          part.pose(own, "placement")};
}

Shape::Kind kind_in(const std::string& key, const std::string& name) {
  static constexpr std::array<const char*, 4> kNames = {"capsule", "box", "cylinder", "hull"};
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    throw BadValue(key, shown(name), fmt::format("{}", fmt::join(kNames, ", ")));
  }
  return static_cast<Shape::Kind>(found - kNames.begin());
}

Shape make_shape(const std::string& key, const py::handle& object,
                 const std::vector<std::string>& links) {
  const Part part(key, object, "Shape");
  Shape shape;
  shape.body = part.text(key + ".body", "body");
  shape.link = index_in(key + ".link", part.get("link"), "link", links);
  shape.kind = kind_in(key + ".kind", part.text(key + ".kind", "kind"));
  shape.placement = part.pose(key + ".placement", "placement");
  shape.radius = part.number(key + ".radius", "radius");
  shape.half_length = part.number(key + ".half_length", "half_length");
  shape.half_sizes = part.numbers(key + ".half_sizes", "half_sizes", 3);
  const Array points = numbers(key + ".points", part.get("points"));
  if (points.size() == 0) return shape;
  const RowMatrix rows = matrix(key + ".points", points, -1, 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) shape.points.emplace_back(rows.row(i));
  return shape;
}

Collision collision_in(const py::object& shapes, const py::object& ignore, double margin,
                       bool find_ignored, const std::vector<std::string>& links) {
  Collision collision;
  collision.shapes = parts_in<Shape>("shapes", shapes, "a list of maxwrench.Shape",
                                     [&links](const std::string& key, const py::handle& object) {
                                       return make_shape(key, object, links);
                                     });
  const char* expected = "a list of pairs of names";
  for (const py::handle& each : items_in("collision.ignore", ignore, expected)) {
    const auto pair = names_in("collision.ignore", py::reinterpret_borrow<py::object>(each));
    if (pair.size() != 2) throw BadValue("collision.ignore", shown(pair), expected);
    collision.ignore.emplace_back(pair[0], pair[1]);
  }
  collision.margin = margin;
  collision.find_ignored = find_ignored;
  return collision;
}

Trim trim_in(const py::object& value) {
  if (value.is_none()) return {};
  const char* expected = "a pair (buoyancy_mass, position)";
  const py::list pair = items_in("trim", value, expected);
  if (py::len(pair) != 2) throw BadValue("trim", std::string(py::repr(value)), expected);
  return {number_in("trim.buoyancy_mass", pair[0]), vector("trim.position", pair[1], 3)};
}

std::map<std::string, std::map<std::string, double>> states_in(const py::object& value) {
  std::map<std::string, std::map<std::string, double>> states;
  if (!py::isinstance<py::dict>(value)) {
    throw BadValue("states", std::string(py::repr(value)), "a dict of postures by name");
  }
  for (const auto& [key, posture] : value.cast<py::dict>()) {
    const std::string name = text_in("states", py::reinterpret_borrow<py::object>(key));
    states[name] = numbers_by_name("states." + name, py::reinterpret_borrow<py::object>(posture));
  }
  return states;
}

PyRobot make_robot(const py::object& links, const py::object& joints, const std::string& name,
                   const py::object& base, const py::object& mount, const py::object& thrusters,
                   const py::object& end_effectors, double gravity, double water_density,
                   const py::object& trim, const py::object& states, const py::object& shapes,
                   const py::object& ignore, double margin, bool find_ignored) {
  Robot robot;
  robot.name = name;
  robot.base_axes = base_axes_in("base", base);
  if (!mount.is_none()) {
    if (!py::isinstance<Pose<double>>(mount)) {
      throw BadValue("mount", std::string(py::repr(mount)), "a maxwrench.Pose");
    }
    robot.mount = mount.cast<Pose<double>>();
  }
  robot.links = parts_in<Link>("links", links, "a list of maxwrench.Link", &make_link);
  const std::vector<std::string> names = part_names(robot.links);
  robot.joints = parts_in<Joint>("joints", joints, "a list of maxwrench.Joint",
                                 [&names](const std::string& key, const py::handle& object) {
                                   return make_joint(key, object, names);
                                 });
  set_gears(joints, robot.joints);
  robot.thrusters =
      parts_in<Thruster>("thrusters", thrusters, "a list of maxwrench.Thruster", &make_thruster);
  robot.end_effectors =
      parts_in<EndEffector>("end_effectors", end_effectors, "a list of maxwrench.EndEffector",
                            [&names](const std::string& key, const py::handle& object) {
                              return make_end_effector(key, object, names);
                            });
  robot.gravity = gravity;
  robot.water_density = water_density;
  robot.trim = trim_in(trim);
  robot.states = states_in(states);
  const Collision collision = collision_in(shapes, ignore, margin, find_ignored, names);
  py::dict how;
  const py::object copied = py::module_::import("copy").attr("deepcopy");
  how["links"] = copied(links);
  how["joints"] = copied(joints);
  how["name"] = name;
  how["base"] = names_in("base", base);
  how["mount"] = mount;
  how["thrusters"] = copied(thrusters);
  how["end_effectors"] = copied(end_effectors);
  how["gravity"] = gravity;
  how["water_density"] = water_density;
  how["trim"] = copied(trim);
  how["states"] = copied(states);
  how["shapes"] = copied(shapes);
  how["ignore"] = copied(ignore);
  how["margin"] = margin;
  how["find_ignored"] = find_ignored;
  return {std::make_shared<const Robot>(finalize(std::move(robot), collision)),
          {"make_robot", how}};
}

constexpr const char* kMakeRobot = R"(Makes a robot in code.

Args:
    links: a list of Link: the base, then one for each joint, which moves it.
    joints: a list of Joint. The one at index i moves the link at index i + 1.
    name: the name.
    base: the free axes of the base, such as "x,y,yaw". Empty: the base is fixed.
    mount: the Pose of the base in the world before it moves along these axes.
    thrusters: a list of Thruster.
    end_effectors: a list of EndEffector.
    gravity: gravity along -z of the world [m/s^2].
    water_density: density of the water [kg/m^3]; 0 in air.
    trim: floats and ballast: a pair of the mass that they carry [kg] and where, in base axes (3)
        [m].
    states: named postures: positions [rad or m] of some joints, by name.
    shapes: a list of Shape, for collisions and figures. Empty: nothing is checked.
    ignore: pairs of bodies, by name, that may touch.
    margin: least distance of two shapes on different links [m].
    find_ignored: leaves out links that a joint connects, and pairs that always touch.
        ``Robot.notes`` then names them.

Returns:
    Robot: the robot.

Raises:
    InputError: a value is wrong; the message names it as the key of a robot file.

>>> robot = maxwrench.make_robot(
...     [maxwrench.Link("stand"), maxwrench.Link("boom", mass=2, com=[0.5, 0, 0])],
...     [maxwrench.Joint("tilt", axis=[0, 1, 0], q_min=-1, q_max=1, effort_max=30)],
...     end_effectors=[maxwrench.EndEffector("hook", "boom", maxwrench.Pose([1, 0, 0]))],
... )
>>> robot.joint_names, robot.end_effectors
(['tilt'], ['hook'])
>>> lift = maxwrench.Static(robot, joints={"tilt": 0}, c="z")
>>> round(maxwrench.evaluate_joints(lift, [0]).beta, 2)  # 30 N m / 1 m - 2 kg g 0.5
20.19
)";

}  // namespace

void add_robot_parts(py::module_& m) {
  m.def("make_robot", &make_robot, py::arg("links"), py::arg("joints") = py::tuple(), py::kw_only(),
        py::arg("name") = "robot", py::arg("base") = "", py::arg("mount") = py::none(),
        py::arg("thrusters") = py::tuple(), py::arg("end_effectors") = py::tuple(),
        py::arg("gravity") = Robot().gravity, py::arg("water_density") = Robot().water_density,
        py::arg("trim") = py::none(), py::arg("states") = py::dict(),
        py::arg("shapes") = py::tuple(), py::arg("ignore") = py::tuple(),
        py::arg("margin") = Collision().margin, py::arg("find_ignored") = Collision().find_ignored,
        kMakeRobot);
}

}  // namespace maxwrench::python
