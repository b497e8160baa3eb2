#include "python/src/task_arguments.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "problems/make/bad_value.h"
#include "problems/make/posture.h"
#include "python/src/arrays.h"
#include "python/src/words.h"

namespace maxwrench::python {

py::object taken(py::dict& arguments, const char* name, py::object otherwise) {
  if (!arguments.contains(name)) return otherwise;
  py::object value = arguments[name];
  arguments.attr("pop")(name);
  return value;
}

namespace {

/// The names of a coordinate of the pose with its limits.
std::map<std::string, std::array<double, 2>> ranges_in(const py::object& value) {
  std::map<std::string, std::array<double, 2>> ranges;
  if (value.is_none()) return ranges;
  if (!py::isinstance<py::dict>(value)) {
    throw BadValue("range", std::string(py::repr(value)), "a dict of limits [min, max] by name");
  }
  for (const auto& [key, limits] : value.cast<py::dict>()) {
    const std::string name = text_in("range", py::reinterpret_borrow<py::object>(key));
    const Eigen::VectorXd pair =
        vector("range." + name, py::reinterpret_borrow<py::object>(limits), 2);
    ranges[name] = {pair[0], pair[1]};
  }
  return ranges;
}

void read_pose(py::dict& arguments, const Robot& robot, TaskSpec& spec) {
  const py::object pose = taken(arguments, "pose"), joints = taken(arguments, "joints");
  if (!pose.is_none() && !joints.is_none()) {
    throw BadValue("pose", "pose and joints", "one of them");
  }
  if (!pose.is_none()) {
    if (!py::isinstance<Pose<double>>(pose)) {
      throw BadValue("pose", std::string(py::repr(pose)), "a maxwrench.Pose");
    }
    spec.pose = pose.cast<Pose<double>>();
  } else if (py::isinstance<py::str>(joints)) {
    spec.posture = named_posture(robot, "joints", joints.cast<std::string>());
  } else if (!joints.is_none()) {
    spec.posture = numbers_by_name("joints", joints);
  } else {
    spec.posture.emplace();
  }
}

/// The arguments of these names that are given; they leave `arguments`.
py::dict given_of(py::dict& arguments, std::initializer_list<const char*> names) {
  py::dict given;
  for (const char* name : names) {
    const py::object value = taken(arguments, name);
    if (!value.is_none() && !value.is(py::bool_(false))) given[name] = value;
  }
  return given;
}

/// Reads c, or what a task has in place of it or beside it. Without any of them c is "z".
void read_scenarios(py::dict& arguments, TaskSpec& spec) {
  const py::dict tables = given_of(arguments, {"uncertainty", "loss", "payload"});
  py::dict wrench = given_of(arguments, {"set", "ball", "hold"});
  const bool needs_c = !wrench.contains("set") && !wrench.contains("ball") &&
                       !tables.contains("payload") && !arguments.contains("wrenches");
  if (needs_c || arguments.contains("c")) {
    const Vector6d c = direction_in("c", taken(arguments, "c", py::str("z")));
    wrench["c"] = copy(Eigen::VectorXd(c));
  }
  read_scenario_arguments(wrench, tables, spec);
  const py::object current = taken(arguments, "current");
  if (!current.is_none()) spec.current = Eigen::Vector3d(vector("current", current, 3));
}

void read_wrench(py::dict& arguments, TaskSpec& spec) {
  read_scenarios(arguments, spec);
  const std::string axes = text_in("frame", taken(arguments, "frame", py::str("world")));
  if (axes != "world" && axes != "end_effector") {
    throw BadValue("frame", shown(axes), "world or end_effector");
  }
  spec.wrench_in_end_effector = axes == "end_effector";
  const py::object any = taken(arguments, "any"), desired = taken(arguments, "desired");
  if (!any.is_none()) spec.any = names_in("any", any);
  if (!desired.is_none()) spec.desired = vector("desired", desired, 6);
  const py::object reference = taken(arguments, "reference");
  if (!reference.is_none()) spec.reference = number_in("reference", reference);
}

void read_theta_r(py::dict& arguments, TaskSpec& spec) {
  const py::object names = taken(arguments, "theta_r"), start = taken(arguments, "theta_r_default");
  if (!names.is_none()) spec.joints = names_in("theta_r", names);
  if (!start.is_none()) spec.theta_r_default = vector("theta_r_default", start);
  const py::object guess = taken(arguments, "guess"), base = taken(arguments, "guess_base");
  if (!guess.is_none()) spec.guess = numbers_by_name("guess", guess);
  if (!base.is_none()) spec.guess_base = numbers_by_name("guess_base", base);
}

void read_free(py::dict& arguments, TaskSpec& spec) {
  const py::object free = taken(arguments, "free");
  if (!free.is_none()) spec.free = names_in("free", free);
  spec.range = ranges_in(taken(arguments, "range"));
  const std::string along = text_in("along", taken(arguments, "along", py::str("pose")));
  if (along != "pose" && along != "end_effector") {
    throw BadValue("along", shown(along), "pose or end_effector");
  }
  spec.along_end_effector = along == "end_effector";
}

}  // namespace

TaskSpec begin_spec(const PyRobot& robot, py::dict& arguments, bool in_time) {
  TaskSpec spec;
  spec.robot = *robot.robot;
  spec.name = text_in("name", taken(arguments, "name", py::str(robot.robot->name)));
  spec.end_effector = text_in("end_effector", taken(arguments, "end_effector", py::str("")));
  if (spec.end_effector.empty() && spec.robot.end_effectors.size() == 1) {
    spec.end_effector = spec.robot.end_effectors.front().name;
  }
  if (!in_time) {
    read_pose(arguments, spec.robot, spec);
    read_free(arguments, spec);
    const py::object contact = taken(arguments, "contact");
    if (!contact.is_none()) spec.contact = contact_in(contact);
  }
  read_wrench(arguments, spec);
  read_theta_r(arguments, spec);
  return spec;
}

void read_scheme(py::dict& arguments, MotionTask& motion) {
  motion.scheme = parse_scheme(
      text_in("scheme", taken(arguments, "scheme", py::str(to_string(motion.scheme)))));
  motion.rates = flag_in("rates", taken(arguments, "rates", py::bool_(true)));
  motion.thruster_lag =
      number_in("thruster_lag", taken(arguments, "thruster_lag", py::float_(0.0)));
  const py::object instants = taken(arguments, "instants_per_interval");
  if (!instants.is_none())
    motion.instants_per_interval = integer_in("instants_per_interval", instants);
}

void require_empty(const py::dict& arguments, const char* function) {
  for (const auto& [key, value] : arguments) {
    throw py::type_error(
        fmt::format("{}: got an unexpected argument '{}'", function, key.cast<std::string>()));
  }
}

}  // namespace maxwrench::python
