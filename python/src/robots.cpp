#include <fmt/format.h>
#include <pybind11/stl.h>

#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "problems/make/bad_value.h"
#include "python/src/arrays.h"
#include "python/src/parts.h"
#include "python/src/words.h"
#include "solvers/solve/format.h"

namespace maxwrench::python {
namespace {

PyRobot from_urdf(const py::object& path, const py::object& base, const std::string& tool,
                  const py::object& srdf, const std::string& group, const py::object& rest,
                  const py::object& packages, const py::object& joints) {
  const std::string file = path_in("path", path);
  UrdfOptions options;
  options.tool = tool;
  options.base_axes = base_axes_in("base", base);
  if (!srdf.is_none()) options.srdf = path_in("srdf", srdf);
  options.group = group;
  if (py::isinstance<py::str>(rest)) {
    options.rest_posture = rest.cast<std::string>();
  } else if (py::isinstance<py::dict>(rest)) {
    options.rest = numbers_by_name("rest", rest);
  } else if (!rest.is_none()) {
    throw BadValue("rest", std::string(py::repr(rest)),
                   "the name of a posture, or a dict of joints and positions");
  }
  if (!joints.is_none()) options.positions = numbers_by_name("joints", joints);
  py::list folders;
  if (py::isinstance<py::str>(packages)) {
    folders.append(packages);
  } else if (py::isinstance<py::iterable>(packages)) {
    folders = py::list(packages);
  } else {
    throw BadValue("packages", std::string(py::repr(packages)), "a list of folders");
  }
  for (const py::handle& folder : folders) {
    options.packages.emplace_back(path_in("packages", py::reinterpret_borrow<py::object>(folder)));
  }
  py::dict how;
  how["path"] = file;
  how["base"] = names_in("base", base);
  how["tool"] = tool;
  how["srdf"] = srdf;
  how["group"] = group;
  how["rest"] = rest;
  how["packages"] = folders;
  how["joints"] = joints;
  return {std::make_shared<const Robot>(load_urdf(file, options)), {"Robot.from_urdf", how}};
}

PyRobot from_toml(const py::object& path, const std::string& limits) {
  const std::string file = path_in("path", path);
  py::dict how;
  how["path"] = file;
  how["limits"] = limits;
  return {std::make_shared<const Robot>(load_robot(file, {limits})), {"Robot.from_toml", how}};
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

std::vector<std::string> actuator_names(const Robot& robot) {
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < robot.actuators(); ++i) names.push_back(actuator_name(robot, i));
  return names;
}

std::vector<std::string> base_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const int axis : robot.base_axes) names.emplace_back(kTwistAxes[std::size_t(axis)]);
  return names;
}

/// One number of each joint.
template <class Number>
py::array of_joints(const Robot& robot, Number number) {
  Eigen::VectorXd v(robot.joints.size());
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    v[Eigen::Index(i)] = number(robot.joints[i]);
  }
  return copy(v);
}

py::list bodies(const PyRobot& self) {
  py::list list;
  for (const ConvexBody& body : self.robot->convex_bodies) {
    RowMatrix points(body.points.size(), 3);
    for (std::size_t i = 0; i < body.points.size(); ++i)
      points.row(Eigen::Index(i)) = body.points[i];
    list.append(py::make_tuple(body.link, copy(points), body.radius));
  }
  return list;
}

std::string repr_of_robot(const PyRobot& self) {
  const Robot& robot = *self.robot;
  const std::vector<std::string> base = base_names(robot);
  return fmt::format("<Robot {}: base {}, {} joints, {} thrusters, end effector{} {}>", robot.name,
                     base.empty() ? "fixed" : fmt::format("{}", fmt::join(base, " ")),
                     robot.joints.size(), robot.thrusters.size(),
                     robot.end_effectors.size() == 1 ? "" : "s",
                     fmt::join(names_of(robot.end_effectors), " "));
}

constexpr const char* kFromUrdf = R"(Reads a robot from a URDF alone.

Args:
    path: the URDF, or a xacro file if xacro is installed.
    base: the free axes of the base, such as "x,y,yaw". The base is parked: it may stand anywhere
        along them, and its brakes hold any load. Empty: the base is fixed.
    tool: the link that is the end effector. Empty: each link without children.
    srdf: SRDF file with collision pairs to leave out, groups and named postures.
    group: the group of the SRDF whose joints move. The other joints are locked; their motors are not
        asked whether they hold. Without ``tool``, the links at its ends are the end effectors.
        Empty: all joints move.
    rest: where the other joints are: the name of a posture of the SRDF, or a dict of joints and
        positions [rad or m]. Joints that it does not have are at zero, or at their limit nearest to
        it.
    packages: folders of packages, in which ``package://`` is searched first.
    joints: positions [rad or m] by name. With ``tool``, a joint that does not move it and has no
        effort is locked: at its position here, else at rest. Joints that move are left as they are.

Raises:
    InputError: the file is missing or something in it is wrong.

>>> robot = maxwrench.Robot.from_urdf("ur10.urdf", base="x,y,yaw", tool="tool0")  # doctest: +SKIP
)";

}  // namespace

void add_robots(py::module_& m) {
  py::class_<PyRobot>(m, "Robot", R"(A robot: a tree of links on a base, with actuators and limits.

It cannot change. ``Robot.from_urdf`` and ``Robot.from_toml`` read one, ``make_robot`` makes one in
code, and ``task.robot`` is the robot of a task.

>>> maxwrench.load("uvms/valve").robot.joint_names
['q1_shoulder_yaw', 'q2_shoulder_pitch', 'q3_elbow', 'q4_wrist_roll']
)")
      .def_static("from_urdf", &from_urdf, py::arg("path"), py::kw_only(), py::arg("base") = "",
                  py::arg("tool") = "", py::arg("srdf") = py::none(), py::arg("group") = "",
                  py::arg("rest") = py::none(), py::arg("packages") = py::tuple(),
                  py::arg("joints") = py::none(), kFromUrdf)
      .def_static("from_toml", &from_toml, py::arg("path"), py::kw_only(), py::arg("limits") = "",
                  R"(Reads a robot from a TOML file and the URDF that it names.

Args:
    path: the TOML file; docs/robot_files.md describes its keys.
    limits: the name of the table in ``[limits]`` that counts. Empty: none.

Raises:
    InputError: the file is missing or something in it is wrong.
)")
      .def_property_readonly(
          "name", [](const PyRobot& r) { return r.robot->name; }, "The name.")
      .def_property_readonly(
          "base", [](const PyRobot& r) { return base_names(*r.robot); },
          "The free axes of the base, of x, y, z, roll, pitch, yaw.")
      .def_property_readonly(
          "joint_names", [](const PyRobot& r) { return names_of(r.robot->joints); },
          "The names of the joints, in the order of all arrays of joints (that of the URDF).")
      .def_property_readonly(
          "link_names", [](const PyRobot& r) { return names_of(r.robot->links); },
          "The names of the links: the base, then one for each joint.")
      .def_property_readonly(
          "thruster_names", [](const PyRobot& r) { return names_of(r.robot->thrusters); },
          "The names of the thrusters.")
      .def_property_readonly(
          "actuator_names", [](const PyRobot& r) { return actuator_names(*r.robot); },
          "The names of the actuators, in the order of u: thrusters, then joints (m).")
      .def_property_readonly(
          "end_effectors", [](const PyRobot& r) { return names_of(r.robot->end_effectors); },
          "The names of the end effectors.")
      .def_property_readonly(
          "end_effector_links",
          [](const PyRobot& r) {
            std::vector<int> links;
            for (const EndEffector& tip : r.robot->end_effectors) links.push_back(tip.link);
            return links;
          },
          "The link that carries each end effector, as an index in link_names.")
      .def_property_readonly(
          "B", [](const PyRobot& r) { return copy(RowMatrix(r.robot->actuation.B)); },
          "Efforts to generalised forces (n×m): free base axes in base axes, then joints.")
      .def_property_readonly(
          "u_min", [](const PyRobot& r) { return copy(r.robot->actuation.u_min); },
          "Lower limits of the efforts (m) [N or N m].")
      .def_property_readonly(
          "u_max", [](const PyRobot& r) { return copy(r.robot->actuation.u_max); },
          "Upper limits of the efforts (m) [N or N m].")
      .def_property_readonly(
          "q_min",
          [](const PyRobot& r) {
            return of_joints(*r.robot, [](const Joint& j) { return j.q_min; });
          },
          "Lower limits of the joints [rad or m].")
      .def_property_readonly(
          "q_max",
          [](const PyRobot& r) {
            return of_joints(*r.robot, [](const Joint& j) { return j.q_max; });
          },
          "Upper limits of the joints [rad or m].")
      .def_property_readonly(
          "velocity_max",
          [](const PyRobot& r) {
            return of_joints(*r.robot, [](const Joint& j) { return j.velocity_max; });
          },
          "Speed limits of the joints [rad/s or m/s].")
      .def_property_readonly(
          "parents",
          [](const PyRobot& r) {
            std::vector<int> parents;
            for (const Joint& joint : r.robot->joints) parents.push_back(joint.parent);
            return parents;
          },
          "The link that carries each joint, as an index in link_names; joint i moves link i + 1.")
      .def_property_readonly("bodies", &bodies,
                             "Convex bodies for figures: (link, points (P×3) in link axes [m], "
                             "radius [m]): all points within the radius of the hull.")
      .def_property_readonly(
          "warnings", [](const PyRobot& r) { return r.robot->warnings; },
          "What is wrong with the robot's data, one line each. Values computed from such data are "
          "as good as the data.")
      .def_property_readonly(
          "notes", [](const PyRobot& r) { return r.robot->notes; },
          "How the data were read, one line each: meshes, collision pairs left out.")
      .def_property_readonly(
          "states", [](const PyRobot& r) { return r.robot->states; },
          "Named postures: positions [rad or m] of some joints, by name.")
      .def("__repr__", &repr_of_robot)
      .def("__reduce__", [](const PyRobot& r) { return reduced(r.recipe); });
}

}  // namespace maxwrench::python
